/** What the focus goes round: the bar above, the panels in front, the time axis and the status bar. */
const PLACES = 'header, [role="tabpanel"], [data-testid="time-axis"], footer';
/** What takes the focus within a place: first of all what is edited there. */
const EDITED = '[data-testid="canvas"], .cm-content, [data-testid="universe-view"]';
const FOCUSABLE =
  'a[href], button:not(:disabled), input:not(:disabled), select:not(:disabled), textarea, [tabindex="0"]';

const isShown = (element: Element): boolean => element.checkVisibility({ visibilityProperty: true });

function targetIn(place: Element): HTMLElement | null {
  const found = [EDITED, FOCUSABLE].flatMap((each) => [...place.querySelectorAll<HTMLElement>(each)]);
  return found.find(isShown) ?? null;
}

/** Moves the keyboard focus to the next panel, or to the one before; returns whether there is another one. */
export function focusPanel(step: 1 | -1, page: Document = document): boolean {
  const places = [...page.querySelectorAll(PLACES)].filter(isShown);
  const here = places.findIndex((place) => place.contains(page.activeElement));
  for (let count = 1; count <= places.length; count += 1) {
    const from = here < 0 && step < 0 ? places.length : here;
    const place = places[(from + step * count + places.length * 2) % places.length];
    const target = place && targetIn(place);
    if (!target || place.contains(page.activeElement)) continue;
    target.focus({ preventScroll: true });
    return true;
  }
  return false;
}
