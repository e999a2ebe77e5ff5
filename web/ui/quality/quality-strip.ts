import { together } from '../widgets/dom';
import { InfoCard } from '../widgets/info-card';
import { createQualityLane, type LanePicture, type Shown } from './quality-lane';
import { type Mark, marksInOne, marksOf, worstRow } from './quality-marks';
import { measureRows } from './quality-rows';
import { laneWords, momentExplained, momentWords, type Part, PART_NAMES } from './quality-words';
import { reactorMotion } from '../store/reactor-motion';
import { danceDuration, danceFps, upToDate } from '../store/selectors';
import type { Services } from '../store/services';
import type { AppState } from '../store/state';
import { type Store, watchAll } from '../store/store';

const PARTS: readonly Part[] = ['feet', 'closeness', 'beats', 'seams'];
/** While it plays, a click lands this much before the moment, so that it is seen coming, seconds. */
const LEAD_IN = 0.5;

/** Room that a mark takes in a row, CSS pixels. */
const MARK_ROOM = 28;

/** All of the dance. */
function whole(state: AppState): Shown {
  return { from: 0, to: danceDuration(state) };
}

/**
 * How good the dance is, along the timeline: four narrow lanes, or in low windows one with the worst of them. The
 * worst moments are numbered; a click goes there.
 * @param root the grid of the timeline's lanes: labels left, lanes right
 * @param shown the part of the dance that the lanes show
 */
export function mountQualityStrip(
  root: HTMLElement,
  store: Store,
  services: Services,
  shown: (state: AppState) => Shown = whole,
): () => void {
  const goTo = ({ moment }: Mark): void => {
    const { playback, quality } = store.getState();
    if (!quality) return;
    const time = moment.frame / quality.reactor.fps;
    services.seek(Math.max(0, playback.playing ? time - LEAD_IN : time));
  };
  const infoCard = new InfoCard(root.closest('section') ?? root);
  const lanes = PARTS.map((part) => createQualityLane(PART_NAMES[part], `q-${part}`, goTo, infoCard));
  const all = createQualityLane('Quality', 'q-all', goTo, infoCard);
  root.append(...[...lanes, all].flatMap(({ label, lane }) => [label, lane]));

  const draw = (state: AppState): void => {
    const { quality, manifest } = state;
    const empty: LanePicture = {
      value: '',
      sentence: 'Nothing to measure yet.',
      measures: [],
      told: true,
      rows: [],
      fps: danceFps(state),
      marks: [],
      shown: shown(state),
    };
    if (!quality || !manifest) {
      for (const lane of [...lanes, all]) lane.draw(empty);
      return;
    }
    const { report, reactor } = quality;
    const { from, to } = empty.shown;
    const reference = state.reference?.model === manifest.id ? state.reference : null;
    const block = (manifest.latent.block * manifest.latent.stride) / manifest.fps;
    const words = laneWords(report, block, reference);
    const measures = measureRows(report, reference);
    const marks = marksOf(report);
    const flagged = (some: readonly Mark[]): LanePicture['marks'] =>
      some.map((mark) => ({
        mark,
        words: momentWords(mark.moment, reactor.fps),
        explained: momentExplained(mark.moment, reactor.fps, report, manifest.quality),
      }));
    PARTS.forEach((part, index) => {
      lanes[index]?.draw({
        ...empty,
        ...words[part],
        measures: measures[part],
        rows: report[part].rows,
        fps: reactor.fps,
        marks: flagged(marks.filter((mark) => mark.part === part)),
      });
    });
    all.draw({
      ...empty,
      sentence: PARTS.map((part) => words[part].sentence).join('\n\n'),
      measures: PARTS.flatMap((part) => measures[part]),
      told: false,
      rows: [worstRow(PARTS.flatMap((part) => report[part].rows))],
      fps: reactor.fps,
      marks: flagged(marksInOne(marks, (MARK_ROOM * (to - from) * reactor.fps) / all.lane.clientWidth)),
    });
  };

  const sizes = new ResizeObserver(() => {
    draw(store.getState());
  });
  sizes.observe(root);
  return together(
    watchAll(
      store,
      (state) => {
        const { from, to } = shown(state);
        return [state.quality, state.reference, state.manifest, state.theme, from, to];
      },
      draw,
    ),
    watchAll(
      store,
      (state) => [state.quality, state.job, state.reaction, reactorMotion(state)],
      (state) => {
        const old = state.quality !== null && state.quality.reactor !== reactorMotion(state);
        const stale = old || (state.job !== null && !upToDate(state));
        for (const lane of [...lanes, all]) lane.setStale(stale);
      },
    ),
    () => {
      sizes.disconnect();
      infoCard.dispose();
      for (const { label, lane } of [...lanes, all]) {
        label.remove();
        lane.remove();
      }
    },
  );
}
