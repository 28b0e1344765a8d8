/**
 * A parser of XML with the offsets of all parts, so that each part can be changed without touching the rest.
 */

export interface XmlAttribute {
  readonly value: string;
  /** The offset of the value between its quotes. */
  readonly start: number;
  readonly end: number;
}

export interface XmlElement {
  readonly tag: string;
  readonly attributes: ReadonlyMap<string, XmlAttribute>;
  readonly children: readonly XmlElement[];
  readonly start: number;
  readonly end: number;
  /** The offset where another attribute would be inserted. */
  readonly headEnd: number;
  /** The offset of the closing tag; null for an empty-element tag. */
  readonly close: number | null;
}

/** A syntax error, with its offset in the text. */
export class XmlError extends Error {
  constructor(
    readonly kind: string,
    readonly offset: number,
    readonly params: Readonly<Record<string, string>> = {},
  ) {
    super(kind);
  }
}

const NAME = /[\p{L}_:][\p{L}\p{N}_:.-]*/uy;
const BLANK = /\s*/y;
const ENTITIES: Readonly<Record<string, string>> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

/** The deepest nesting that is accepted; hand-written files are far below it. */
const DEEPEST = 200;

class Reader {
  at = 0;

  constructor(readonly text: string) {}

  has(word: string): boolean {
    return this.text.startsWith(word, this.at);
  }

  skip(pattern: RegExp): string {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text)?.[0] ?? '';
    this.at += found.length;
    return found;
  }

  /** Moves the position behind the next occurrence of a word. */
  pass(word: string, kind: string): void {
    const end = this.text.indexOf(word, this.at);
    if (end < 0) throw new XmlError(kind, this.at);
    this.at = end + word.length;
  }

  /** Skips comments, instructions and text up to the next element or end tag, or the end of the text. */
  misc(isInside: boolean): void {
    while (this.at < this.text.length) {
      if (this.has('<!--')) this.pass('-->', 'xmlComment');
      else if (this.has('<?')) this.pass('?>', 'xmlOpen');
      else if (isInside && this.has('<![CDATA[')) this.pass(']]>', 'xmlOpen');
      else if (this.has('<!')) throw new XmlError('xmlDoctype', this.at);
      else if (this.has('<')) return;
      else {
        const start = this.at;
        const next = this.text.indexOf('<', this.at);
        this.at = next < 0 ? this.text.length : next;
        const words = this.text.slice(start, this.at);
        if (!isInside && words.trim() !== '' && words.trim() !== '\uFEFF')
          throw new XmlError('xmlText', start);
        decoded(words, start);
      }
    }
  }

  element(depth: number): XmlElement {
    const start = this.at;
    if (depth > DEEPEST) throw new XmlError('xmlDeep', start);
    this.at += 1;
    const tag = this.skip(NAME);
    if (tag === '') throw new XmlError('xmlTag', start);
    const attributes = this.attributes(tag);
    const headEnd = this.at;
    this.skip(BLANK);
    if (this.has('/>')) {
      this.at += 2;
      return { tag, attributes, children: [], start, end: this.at, headEnd, close: null };
    }
    if (!this.has('>')) throw new XmlError('xmlTagEnd', this.at, { tag });
    this.at += 1;
    const children: XmlElement[] = [];
    for (;;) {
      this.misc(true);
      if (this.at >= this.text.length) throw new XmlError('xmlUnclosed', start, { tag });
      if (this.has('</')) break;
      children.push(this.element(depth + 1));
    }
    const close = this.at;
    this.at += 2;
    const closed = this.skip(NAME);
    this.skip(BLANK);
    if (closed !== tag || !this.has('>')) throw new XmlError('xmlClose', close, { tag, closed });
    this.at += 1;
    return { tag, attributes, children, start, end: this.at, headEnd, close };
  }

  private attributes(tag: string): Map<string, XmlAttribute> {
    const found = new Map<string, XmlAttribute>();
    for (;;) {
      const before = this.at;
      const blank = this.skip(BLANK);
      const nameAt = this.at;
      const name = blank === '' ? '' : this.skip(NAME);
      if (name === '') {
        this.at = before;
        return found;
      }
      if (found.has(name)) throw new XmlError('xmlTwice', nameAt, { name });
      this.skip(BLANK);
      if (!this.has('=')) throw new XmlError('xmlValue', nameAt, { name });
      this.at += 1;
      this.skip(BLANK);
      const quote = this.text[this.at];
      if (quote !== '"' && quote !== "'") throw new XmlError('xmlValue', nameAt, { name });
      const start = this.at + 1;
      this.at = start;
      this.pass(quote, 'xmlValue');
      const end = this.at - 1;
      const raw = this.text.slice(start, end);
      if (raw.includes('<')) throw new XmlError('xmlTagEnd', nameAt, { tag });
      found.set(name, { value: decoded(raw, start), start, end });
    }
  }
}

function decoded(raw: string, at: number): string {
  return raw.replace(/&([^;\s<&]*)(;?)/g, (whole: string, name: string, end: string, offset: number) => {
    const code = /^#(?:x([0-9a-fA-F]{1,6})|(\d{1,7}))$/.exec(name);
    const point = code ? parseInt(code[1] ?? code[2] ?? '', code[1] === undefined ? 10 : 16) : NaN;
    const character = point <= 0x10ffff ? String.fromCodePoint(point) : ENTITIES[name];
    if (end === '' || character === undefined)
      throw new XmlError('xmlEntity', at + offset, { entity: whole });
    return character;
  });
}

/**
 * Parses a document's root element.
 *
 * @throws XmlError if the text is not well-formed, or has a DOCTYPE.
 */
export function parseXml(text: string): XmlElement {
  const reader = new Reader(text);
  reader.misc(false);
  if (reader.at >= text.length) throw new XmlError('xmlEmpty', 0);
  const root = reader.element(0);
  reader.misc(false);
  if (reader.at < text.length) throw new XmlError('xmlSecond', reader.at);
  return root;
}

export const escaped = (value: string): string =>
  value.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');

export const child = (element: XmlElement | undefined, tag: string): XmlElement | undefined =>
  element?.children.find((each) => each.tag === tag);
export const children = (element: XmlElement, tag: string): XmlElement[] =>
  element.children.filter((each) => each.tag === tag);
export const attribute = (element: XmlElement | undefined, name: string): string | undefined =>
  element?.attributes.get(name)?.value;
