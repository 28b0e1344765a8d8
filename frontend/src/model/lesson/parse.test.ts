import { describe, expect, it } from 'vitest';
import { parseLesson, parseSpans, parseTry } from './parse';

describe('parseTry', () => {
  it.each([
    ['try:select=Forward', { kind: 'select', block: 'Forward' }],
    ['try:select=keep clear', { kind: 'select', block: 'keep clear' }],
    ['try:set=Forward.lin_speed=0.15', { kind: 'set', block: 'Forward', port: 'lin_speed', value: '0.15' }],
    ['try:set=A.code=x = 1', { kind: 'set', block: 'A', port: 'code', value: 'x = 1' }],
    ['try:open=actions/Turn.py:12', { kind: 'open', path: 'actions/Turn.py', line: 12 }],
    ['try:open=universes/yard.yaml', { kind: 'open', path: 'universes/yard.yaml', line: null }],
    ['try:run', { kind: 'run' }],
  ])('reads %s', (address, act) => {
    expect(parseTry(address)).toEqual(act);
  });

  it.each(['https://example.org', 'javascript:alert(1)', 'try:', 'try:erase=all', 'try:set=Forward=1', ''])(
    'refuses %s',
    (address) => {
      expect(parseTry(address)).toBeNull();
    },
  );
});

describe('parseSpans', () => {
  it('reads emphasis, code and a button', () => {
    expect(parseSpans('A **b** *c* `d` [Try it](try:run).')).toEqual([
      { kind: 'text', text: 'A ' },
      { kind: 'strong', text: 'b' },
      { kind: 'text', text: ' ' },
      { kind: 'emphasis', text: 'c' },
      { kind: 'text', text: ' ' },
      { kind: 'code', text: 'd' },
      { kind: 'text', text: ' ' },
      { kind: 'try', text: 'Try it', act: { kind: 'run' } },
      { kind: 'text', text: '.' },
    ]);
  });

  it('shows links elsewhere, HTML and pictures as text', () => {
    const spans = parseSpans('[site](https://x.y) <img src=x onerror=alert(1)> ![p](https://x.y/p.png)');
    expect(spans.every(({ kind }) => kind === 'text')).toBe(true);
    expect(spans.map(({ text }) => text).join('')).toBe('site <img src=x onerror=alert(1)> !p');
  });

  it('accepts a value with parentheses', () => {
    expect(parseSpans('[Try](try:set=Near.code=(x - 1) < 2)')).toEqual([
      { kind: 'try', text: 'Try', act: { kind: 'set', block: 'Near', port: 'code', value: '(x - 1) < 2' } },
    ]);
  });
});

describe('parseLesson', () => {
  it('reads headings, paragraphs, lists and code', () => {
    const text =
      '# Title\nOne\nline.\n\n- a\n  and b\n- c\n1. first\n\n```\n# not a title\n<b>\n```\n## Then';
    expect(parseLesson(text)).toEqual([
      { kind: 'heading', level: 1, spans: [{ kind: 'text', text: 'Title' }] },
      { kind: 'paragraph', spans: [{ kind: 'text', text: 'One line.' }] },
      {
        kind: 'list',
        isOrdered: false,
        items: [[{ kind: 'text', text: 'a and b' }], [{ kind: 'text', text: 'c' }]],
      },
      { kind: 'list', isOrdered: true, items: [[{ kind: 'text', text: 'first' }]] },
      { kind: 'code', text: '# not a title\n<b>' },
      { kind: 'heading', level: 2, spans: [{ kind: 'text', text: 'Then' }] },
    ]);
  });

  it.each(['', '```', '#', '- ', '[', '[[[[', '**', '\r\n\r\n', '# ', '* *'])('ends on %j', (text) => {
    expect(Array.isArray(parseLesson(text))).toBe(true);
  });

  it('bounds the parsing of a text that is made to be slow', () => {
    const blocks = parseLesson('[a](try:set=('.repeat(100_000));
    expect(JSON.stringify(blocks).length).toBeLessThan(60_000);
  });
});
