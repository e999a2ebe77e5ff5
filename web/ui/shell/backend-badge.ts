import { textButton } from '../widgets/button';
import { mountDeviceCard } from './device-card';
import { el, setText } from '../widgets/dom';
import { createMeter } from '../widgets/meter';
import { icon } from '../widgets/icons';
import { bytesOf, capitalised } from '../store/format';
import type { Mount } from '../store/services';
import type { ModelState } from '../store/state';
import { apply, watch } from '../store/store';
import { panelToggled } from '../store/actions/view';

/** What computes the dance, in one word. */
const BACKENDS = { webgpu: 'WebGPU', wasm: 'Processor' } as const;

/** What computes the dance; while the model is being downloaded, the progress of that. Why is in the card that it opens. */
export const mountBackendBadge: Mount = (root, store, services) => {
  const title = el('b');
  const meter = createMeter('Model');
  const bytes = el('span', { class: 'bytes' });
  const dot = el('span', { class: 'dot', attributes: { 'aria-hidden': 'true' } });
  const again = textButton('btn tint', 'Try again', services.retryModel);
  const about = el(
    'button',
    {
      class: 'about',
      attributes: { type: 'button', 'aria-haspopup': 'dialog' },
      on: {
        click: () => {
          apply(store, panelToggled('device'));
        },
      },
    },
    el('span', { class: 'phone-only' }, icon('device')),
    dot,
    title,
  );
  const badge = el('div', { class: 'badge' }, about, meter.element, bytes, again);
  root.append(badge);
  mountDeviceCard(badge, about, store, services);

  const show = (model: ModelState): void => {
    const loading = model.phase === 'loading';
    meter.element.hidden = bytes.hidden = !loading;
    dot.hidden = model.phase !== 'ready';
    if (model.phase !== 'failed' && again === document.activeElement) about.focus();
    again.hidden = model.phase !== 'failed';
    badge.className = `badge ${model.phase}`;
    about.title = '';
    if (model.phase === 'loading') {
      const part = model.total > 0 ? model.received / model.total : 0;
      const text = loadingText(model);
      setText(title, text.title);
      setText(bytes, text.detail);
      about.title = `${text.title} ${text.detail}`.trim();
      meter.element.setAttribute('aria-label', text.title);
      meter.show(part);
    } else if (model.phase === 'ready') {
      setText(title, BACKENDS[model.backend]);
      about.title = `What computes the dance: ${model.reason}`;
    } else {
      setText(title, 'No model');
      about.title = model.problem.title;
    }
  };
  watch(store, (state) => state.model, show);
};

type Loading = Extract<ModelState, { readonly phase: 'loading' }>;

/** What is being downloaded and the progress of that: `Runtime`, `12.0 of 14.2 MB, model from this device`. */
export function loadingText({ label, received, total, parts = [] }: Loading): {
  readonly title: string;
  readonly detail: string;
} {
  if (parts.length === 0) return { title: label, detail: total > 0 ? bytesOf(received, total) : '' };
  const downloading = parts.filter(({ cached, total }) => cached < total);
  const fromCache = parts.filter(({ cached, total }) => cached >= total);
  if (downloading.length === 0) return { title: capitalised(named(fromCache)), detail: 'from this device' };
  const loaded = downloading.reduce((sum, part) => sum + part.loaded, 0);
  const whole = downloading.reduce((sum, part) => sum + part.total, 0);
  return {
    title: capitalised(named(downloading)),
    detail: bytesOf(loaded, whole) + (fromCache.length > 0 ? `, ${named(fromCache)} from this device` : ''),
  };
}

function named(parts: readonly { readonly name: string }[]): string {
  return parts.map(({ name }) => name).join(' and ');
}
