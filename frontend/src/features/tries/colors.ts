/** The angle between the hues of rows that follow each other: neighbours differ, and none comes twice. */
const GOLDEN_DEGREES = 137.5;

/** Returns the colour of a row; that of the run as it is has none of its own. */
export const colorOf = (index: number): string =>
  index === 0
    ? 'var(--bts-text)'
    : `hsl(${Math.round(((index - 1) * GOLDEN_DEGREES + 215) % 360)} 70% var(--tries-lightness))`;
