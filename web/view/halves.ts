/** What the two halves are called. */
export interface Labels {
  readonly a: string;
  readonly b: string;
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
  const [a, b] = [make('half a'), make('half b')];
  const seam = make('halves');
  seam.append(a, b);
  seam.hidden = true;
  host.append(seam);
  return {
    show(labels) {
      seam.hidden = labels === null;
      a.textContent = labels?.a ?? '';
      b.textContent = labels?.b ?? '';
    },
    dispose() {
      seam.remove();
    },
  };
}
