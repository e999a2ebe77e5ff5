import { oneSet } from '../store/actions/counting';
import type { Services } from '../store/services';
import { apply, type Store } from '../store/store';

/**
 * What a click on ruler or song does, and a tap on any lane: it makes the nearest beat a "1" with Alt, or when that was
 * asked for; else it jumps there.
 * @param time seconds of the dance
 */
export function timelineClicked(store: Store, services: Services, time: number, event: PointerEvent): void {
  if (event.altKey || store.getState().settingOne) apply(store, oneSet(time));
  else services.seek(time);
}
