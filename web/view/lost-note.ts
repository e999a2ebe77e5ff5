import type { Stage } from './stage';

/** Shows in `place` that the stage is empty because the browser has stopped drawing it, until it goes on. */
export function mountLostNote(stage: Stage, place: HTMLElement): void {
  const note = document.createElement('p');
  note.className = 'lost-note';
  // Empty instead of hidden, so that screen readers watch it.
  note.setAttribute('role', 'status');
  place.append(note);
  stage.onLost((lost) => {
    note.textContent = lost
      ? 'The graphics card has stopped drawing the dancers. It usually goes on by itself in a moment. If it does not, reload the page.'
      : '';
  });
}
