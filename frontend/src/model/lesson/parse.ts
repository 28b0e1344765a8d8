/** The effect of a *Try it* button in a lesson. Blocks are referred to by instance name or type. */
export type Try =
  | { readonly kind: 'select'; readonly block: string }
  | { readonly kind: 'set'; readonly block: string; readonly port: string; readonly value: string }
  | { readonly kind: 'open'; readonly path: string; readonly line: number | null }
  | { readonly kind: 'run' };

export type Span =
  | { readonly kind: 'text' | 'strong' | 'emphasis' | 'code'; readonly text: string }
  | { readonly kind: 'try'; readonly text: string; readonly act: Try };

export type Spans = readonly Span[];

export type Block =
  | { readonly kind: 'heading'; readonly level: 1 | 2 | 3; readonly spans: Spans }
  | { readonly kind: 'paragraph'; readonly spans: Spans }
  | { readonly kind: 'list'; readonly isOrdered: boolean; readonly items: readonly Spans[] }
  | { readonly kind: 'code'; readonly text: string };

/**
 * The most characters that are drawn; the rest is cut, since anyone can write a lesson and all of it is drawn
 * at once.
 */
const MOST_CHARACTERS = 40_000;

const HEADING = /^(#{1,3}) (.+)$/;
const ITEM = /^(?:[-*]|(\d{1,3})[.)]) (.+)$/;
const FENCE = '```';

/** `**strong**`, `*emphasis*`, `code` and links. Lengths are bounded, so that no text takes long to match. */
const INLINE =
  /\*\*([^*\n]{1,500})\*\*|\*([^*\n]{1,500})\*|`([^`\n]{1,500})`|\[([^[\]\n]{1,200})\]\(([^()\n]{0,500}(?:\([^()\n]{0,200}\)[^()\n]{0,200}){0,8})\)/g;

/** Returns the effect of a link such as `try:set=Forward.lin_speed=0.15`; null for any other link. */
export function parseTry(address: string): Try | null {
  if (address === 'try:run') return { kind: 'run' };
  const [, verb, rest = ''] = /^try:(select|set|open)=(.+)$/.exec(address) ?? [];
  if (verb === 'select') return { kind: 'select', block: rest };
  if (verb === 'set') {
    const [, block = '', port = '', value = ''] = /^([^=]{1,200})\.([A-Za-z]\w{0,80})=(.*)$/.exec(rest) ?? [];
    return block ? { kind: 'set', block, port, value } : null;
  }
  if (verb === 'open') {
    const [, path = '', line] = /^([^:]{1,400}?)(?::(\d{1,6}))?$/.exec(rest) ?? [];
    return path ? { kind: 'open', path, line: line ? Number(line) : null } : null;
  }
  return null;
}

function spanOf(match: RegExpExecArray): Span {
  const [, strong, emphasis, code, label = '', address = ''] = match;
  if (strong !== undefined) return { kind: 'strong', text: strong };
  if (emphasis !== undefined) return { kind: 'emphasis', text: emphasis };
  if (code !== undefined) return { kind: 'code', text: code };
  const act = parseTry(address);
  // No link leaves the page: other links are shown as their text.
  return act ? { kind: 'try', text: label, act } : { kind: 'text', text: label };
}

export function parseSpans(text: string): Spans {
  const spans: Span[] = [];
  let end = 0;
  for (const match of text.matchAll(INLINE)) {
    if (match.index > end) spans.push({ kind: 'text', text: text.slice(end, match.index) });
    spans.push(spanOf(match));
    end = match.index + match[0].length;
  }
  if (end < text.length) spans.push({ kind: 'text', text: text.slice(end) });
  return spans;
}

/** Removes lines from the front of `lines` while `belongs` is true, and returns them. */
function takeWhile(lines: string[], belongs: (line: string) => boolean): string[] {
  const end = lines.findIndex((line) => !belongs(line));
  return lines.splice(0, end < 0 ? lines.length : end);
}

const isPlain = (line: string) =>
  line.trim() !== '' && !HEADING.test(line) && !ITEM.test(line) && !line.startsWith(FENCE);

function takeItem(lines: string[]): Spans {
  const [, , first = ''] = ITEM.exec(lines.shift() ?? '') ?? [];
  const more = takeWhile(lines, (line) => line.startsWith('  ') && line.trim() !== '');
  return parseSpans([first, ...more.map((line) => line.trim())].join(' '));
}

function takeList(lines: string[]): Block {
  const isOrdered = /^\d/.test(lines[0] ?? '');
  const items: Spans[] = [];
  while (ITEM.test(lines[0] ?? '') && /^\d/.test(lines[0] ?? '') === isOrdered) items.push(takeItem(lines));
  return { kind: 'list', isOrdered, items };
}

function takeBlock(lines: string[]): Block | null {
  const line = lines[0] ?? '';
  if (line.trim() === '') {
    lines.shift();
    return null;
  }
  const [, marks, title] = HEADING.exec(line) ?? [];
  if (marks && title) {
    lines.shift();
    return { kind: 'heading', level: marks.length as 1 | 2 | 3, spans: parseSpans(title) };
  }
  if (line.startsWith(FENCE)) {
    lines.shift();
    const text = takeWhile(lines, (each) => !each.startsWith(FENCE)).join('\n');
    lines.shift();
    return { kind: 'code', text };
  }
  if (ITEM.test(line)) return takeList(lines);
  const text = takeWhile(lines, isPlain).map((each) => each.trim());
  return { kind: 'paragraph', spans: parseSpans(text.join(' ')) };
}

/**
 * Parses a lesson: a small part of Markdown, with *Try it* links (`docs/reference/lessons.md`). HTML,
 * pictures and other links become text.
 */
export function parseLesson(text: string): readonly Block[] {
  const lines = text.slice(0, MOST_CHARACTERS).split(/\r?\n/);
  const blocks: Block[] = [];
  while (lines.length > 0) {
    const block = takeBlock(lines);
    if (block) blocks.push(block);
  }
  return blocks;
}
