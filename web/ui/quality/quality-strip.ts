import { onPixelSize } from '../../common/pixel-size';
import { InfoCard } from '../widgets/info-card';
import { createQualityLane, type LaneContent, type QualityLane } from './quality-lane';
import { type Mark, marksInOne, marksOf, worstRow } from './quality-marks';
import { measureRows } from './quality-rows';
import { laneTexts, momentCard, momentLabel, type Part, PART_NAMES } from './quality-text';
import { reactorMotion } from '../store/reactor-motion';
import { danceFps, isSampling } from '../store/selectors';
import type { Manifest } from '../../model/client';
import { visibleSpan } from '../store/actions/timeline';
import type { Services } from '../store/services';
import type { AppState, Quality } from '../store/state';
import { type Store, watchAll } from '../store/store';
import type { Span } from '../store/time-scale';

const PARTS: readonly Part[] = ['feet', 'closeness', 'beats', 'seams'];
/** Width that a mark takes in a row, CSS pixels. */
const MARK_WIDTH = 28;

/**
 * The quality of the dance along the timeline: a narrow lane for each part, and one of the worst of them, which low
 * windows show instead. The worst moments are numbered; a click plays the seconds around one in a loop.
 * @param root the grid of the timeline's lanes: labels left, lanes right
 */
export function mountQualityStrip(root: HTMLElement, store: Store, services: Services): void {
  const jumpTo = ({ part, moment }: Mark): void => {
    const { quality } = store.getState();
    if (quality) services.showMoment(part, moment.frame / quality.reactor.fps);
  };
  const cards = new InfoCard(root.closest('section') ?? root);
  const partLanes = PARTS.map((part) =>
    createQualityLane(PART_NAMES[part], `quality-${part}`, jumpTo, cards),
  );
  const worstLane = createQualityLane('Quality', 'quality-all', jumpTo, cards);
  const lanes = [...partLanes, worstLane];
  root.append(...lanes.flatMap(({ label, lane }) => [label, lane]));

  const draw = (state: AppState): void => {
    drawLanes(partLanes, worstLane, state, visibleSpan(state));
  };
  onPixelSize(root, () => {
    draw(store.getState());
  });
  markWhileLookedAt(root, lanes);
  watchAll(
    store,
    (state) => {
      const { from, to } = visibleSpan(state);
      return [state.quality, state.reference, state.manifest, state.theme, from, to];
    },
    draw,
  );
  watchAll(
    store,
    (state) => [state.quality, state.job, state.reaction, reactorMotion(state)],
    (state) => {
      for (const lane of lanes) lane.setStale(isStale(state));
    },
  );
}

/** Whether the measures are of another motion than the one on the stage, or that one is being replaced. */
function isStale(state: AppState): boolean {
  const { quality } = state;
  const ofAnother = quality !== null && quality.reactor !== reactorMotion(state);
  return ofAnother || isSampling(state);
}

/**
 * Marks `root` as `looked-at` while the pointer or the focus is in one of the lanes, and after a tap until the next one
 * elsewhere.
 */
function markWhileLookedAt(root: HTMLElement, lanes: readonly QualityLane[]): void {
  const parts = lanes.flatMap(({ label, lane }) => [label, lane]);
  const isInside = (target: EventTarget | null): boolean =>
    target instanceof Node && parts.some((part) => part.contains(target));
  const follow = ({ target, type }: Event): void => {
    const focused = type === 'pointerover' && isInside(document.activeElement);
    root.classList.toggle('looked-at', focused || isInside(target));
  };
  window.addEventListener('pointerover', follow);
  window.addEventListener('pointerdown', follow);
  window.addEventListener('focusin', follow);
}

function drawLanes(
  partLanes: readonly QualityLane[],
  worstLane: QualityLane,
  state: AppState,
  shown: Span,
): void {
  const empty: LaneContent = {
    value: '',
    sentence: 'Nothing to measure yet.',
    measures: [],
    sentenceInCard: true,
    rows: [],
    fps: danceFps(state),
    marks: [],
    shown,
  };
  const { quality, manifest } = state;
  if (!quality || !manifest) {
    for (const lane of [...partLanes, worstLane]) lane.draw(empty);
    return;
  }
  const marksApart =
    (MARK_WIDTH * (shown.to - shown.from) * quality.reactor.fps) / worstLane.lane.clientWidth;
  const { parts, worst } = laneContents(empty, quality, manifest, state, marksApart);
  parts.forEach((picture, index) => {
    partLanes[index]?.draw(picture);
  });
  worstLane.draw(worst);
}

/**
 * What the lanes show of a measured dance.
 * @param empty what a lane without measures shows
 * @param marksApart least distance of two marks in the one lane of the worst, frames
 */
function laneContents(
  empty: LaneContent,
  { report, reactor }: Quality,
  manifest: Manifest,
  state: AppState,
  marksApart: number,
): { readonly parts: readonly LaneContent[]; readonly worst: LaneContent } {
  const { fps } = reactor;
  const reference = state.reference?.model === manifest.id ? state.reference : null;
  const blockSeconds = (manifest.latent.block * manifest.latent.stride) / manifest.fps;
  const texts = laneTexts(report, blockSeconds, reference);
  const measures = measureRows(report, reference);
  const marks = marksOf(report);
  const labelled = (some: readonly Mark[]): LaneContent['marks'] =>
    some.map((mark) => ({
      mark,
      label: momentLabel(mark.moment, fps),
      card: momentCard(mark.moment, fps, report, manifest.quality),
    }));
  return {
    parts: PARTS.map((part) => ({
      ...empty,
      ...texts[part],
      measures: measures[part],
      rows: report[part].rows,
      fps,
      marks: labelled(marks.filter((mark) => mark.part === part)),
    })),
    worst: {
      ...empty,
      sentence: PARTS.map((part) => texts[part].sentence).join('\n\n'),
      measures: PARTS.flatMap((part) => measures[part]),
      sentenceInCard: false,
      rows: [worstRow(PARTS.flatMap((part) => report[part].rows))],
      fps,
      marks: labelled(marksInOne(marks, marksApart)),
    },
  };
}
