export interface Span {
  text: string;
  /** The names of styles: `red`, `bright-red`, `bold`, `dim`, `underline`. */
  styles: string[];
}

const COLORS = ['black', 'red', 'green', 'yellow', 'blue', 'magenta', 'cyan', 'white'];

// Escape sequences begin with a control character, so the pattern must contain one.
// eslint-disable-next-line no-control-regex
const SEQUENCE = /\u001b\[([0-9;]*)([A-Za-z])/g;

function applyCode(styles: string[], code: number): string[] {
  const without = (test: (style: string) => boolean) => styles.filter((style) => !test(style));
  const isColor = (style: string) => COLORS.includes(style.replace('bright-', ''));
  if (code === 0) return [];
  if (code === 1) return [...styles, 'bold'];
  if (code === 2) return [...styles, 'dim'];
  if (code === 4) return [...styles, 'underline'];
  if (code === 22) return without((style) => style === 'bold' || style === 'dim');
  if (code === 24) return without((style) => style === 'underline');
  if (code === 39) return without(isColor);
  if (code >= 30 && code <= 37) return [...without(isColor), COLORS[code - 30] ?? 'white'];
  if (code >= 90 && code <= 97) return [...without(isColor), `bright-${COLORS[code - 90] ?? 'white'}`];
  return styles;
}

/** Splits a line at its ANSI sequences; sequences that set no style (such as cursor moves) are dropped. */
export function parseAnsi(line: string): Span[] {
  const spans: Span[] = [];
  let styles: string[] = [];
  let end = 0;
  for (const match of line.matchAll(SEQUENCE)) {
    const text = line.slice(end, match.index);
    if (text) spans.push({ text, styles });
    end = match.index + match[0].length;
    if (match[2] !== 'm') continue;
    for (const code of (match[1] || '0').split(';')) styles = applyCode(styles, Number(code));
  }
  const rest = line.slice(end);
  if (rest || spans.length === 0) spans.push({ text: rest, styles });
  return spans;
}

export function plainText(line: string): string {
  return line.replace(SEQUENCE, '');
}
