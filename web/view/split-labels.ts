/** Names of the two halves of a split view. */
export interface Labels {
  readonly left: string;
  readonly right: string;
}

/** The line between the halves of a split view, with the name of each half at its lower end. */
export interface SplitLabels {
  /** Shows the names, or hides line and names. */
  show(labels: Labels | null): void;
}

export function createSplitLabels(host: HTMLElement): SplitLabels {
  const make = (className: string): HTMLElement => {
    const element = document.createElement('div');
    element.className = className;
    return element;
  };
  const [left, right] = [make('split-label a'), make('split-label b')];
  const line = make('split-labels');
  line.append(left, right);
  line.hidden = true;
  host.append(line);
  return {
    show(labels) {
      line.hidden = labels === null;
      left.textContent = labels?.left ?? '';
      right.textContent = labels?.right ?? '';
    },
  };
}
