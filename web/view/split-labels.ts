/** What the two halves are called. */
export interface Labels {
  readonly left: string;
  readonly right: string;
}

/** The seam between the halves of the picture and the words at its foot. */
export interface Halves {
  show(labels: Labels | null): void;
  dispose(): void;
}

export function createHalves(host: HTMLElement): Halves {
  const make = (className: string): HTMLElement => {
    const element = document.createElement('div');
    element.className = className;
    return element;
  };
  const [left, right] = [make('half a'), make('half b')];
  const seam = make('halves');
  seam.append(left, right);
  seam.hidden = true;
  host.append(seam);
  return {
    show(labels) {
      seam.hidden = labels === null;
      left.textContent = labels?.left ?? '';
      right.textContent = labels?.right ?? '';
    },
    dispose() {
      seam.remove();
    },
  };
}
