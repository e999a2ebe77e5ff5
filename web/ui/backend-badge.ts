import { bytesOf } from './format';
import { el, setText, setVariable, together } from './dom';
import type { Mount } from './services';
import type { ModelState } from './state';
import { watch } from './store';

const BACKENDS = { webgpu: 'WebGPU', wasm: 'WebAssembly' } as const;

/** What computes and why; while the model comes, how much of it is here. */
export const mountBackendBadge: Mount = (root, store, services) => {
  const title = el('b');
  const fill = el('i');
  const meter = el(
    'span',
    { class: 'meter', attributes: { role: 'progressbar', 'aria-valuemin': 0, 'aria-valuemax': 100 } },
    fill,
  );
  const bytes = el('span', { class: 'bytes' });
  const dot = el('span', { class: 'dot', attributes: { 'aria-hidden': 'true' } });
  const why = el('span', { class: 'why' });
  const again = el('button', {
    class: 'btn tint',
    text: 'Try again',
    attributes: { type: 'button' },
    on: {
      click: () => {
        services.retryModel();
      },
    },
  });
  const badge = el('div', { class: 'badge' }, dot, title, meter, bytes, why, again);
  root.append(badge);

  const show = (model: ModelState): void => {
    const loading = model.phase === 'loading';
    meter.hidden = bytes.hidden = !loading;
    dot.hidden = why.hidden = model.phase !== 'ready';
    again.hidden = model.phase !== 'failed';
    badge.className = `badge ${model.phase}`;
    badge.title = '';
    if (model.phase === 'loading') {
      const part = model.total > 0 ? model.received / model.total : 0;
      setText(title, model.label);
      setText(bytes, model.total > 0 ? bytesOf(model.received, model.total) : '');
      setVariable(fill, '--part', part);
      meter.setAttribute('aria-label', model.label);
      meter.setAttribute('aria-valuenow', String(Math.round(part * 100)));
    } else if (model.phase === 'ready') {
      setText(title, BACKENDS[model.backend]);
      setText(why, model.reason.replace(/\.$/, ''));
      const threads =
        model.backend === 'wasm' ? `, ${model.threads} thread${model.threads === 1 ? '' : 's'}` : '';
      badge.title = `Computes on ${BACKENDS[model.backend]}${threads}: ${model.reason}`;
    } else {
      setText(title, 'No model');
      badge.title = model.problem.title;
    }
  };
  return together(
    watch(store, (state) => state.model, show),
    () => {
      badge.remove();
    },
  );
};
