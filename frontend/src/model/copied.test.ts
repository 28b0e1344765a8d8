import { describe, expect, it } from 'vitest';
import { readCopied, withoutFiles, writeCopied, type Origin } from './copied';
import type { Fragment } from './edits';
import { parseDiagram, serializeDiagram } from './serialize';

const fragment: Fragment = { tops: ['a'], nodes: { a: { type: 'Turn', ports: { speed: '0.4' } } } };
const tree = serializeDiagram(
  parseDiagram({ format: 'bt-studio/diagram', version: 1, id: 'Dock', root: null, nodes: {}, drafts: [] }),
);
const origin: Origin = {
  project: 'p2',
  name: 'Bump -- and go -->',
  files: {
    'actions/Turn.py': 'class Turn:\n    """--> a comment ends -- here"""\n',
    'trees/Dock.json': tree,
  },
};
const text = writeCopied(fragment, origin);
/** The text with another document in its comment. */
const withJson = (change: (document: Record<string, unknown>) => void): string => {
  const document = JSON.parse(/<!-- (.*) -->/.exec(text)?.[1] ?? '') as Record<string, unknown>;
  change(document);
  return text.replace(/<!-- .* -->/, () => `<!-- ${JSON.stringify(document)} -->`);
};
const withFiles = (files: Record<string, unknown>) => withJson((document) => (document['files'] = files));

describe('copied blocks', () => {
  it('come back with the files that they use', () => {
    const copied = readCopied(text);
    expect(Object.values(copied?.fragment.nodes ?? {})).toEqual([fragment.nodes['a']]);
    expect(copied).toMatchObject({ origin, isDamaged: false });
  });

  it('are plain XML for every other program', () => {
    expect(withoutFiles(text)).toBe('<Turn speed="0.4"/>');
    const xml = new DOMParser().parseFromString(`<a>${text}</a>`, 'application/xml');
    expect(xml.querySelector('parsererror')).toBeNull();
    expect(xml.querySelectorAll('a > *')).toHaveLength(1);
  });

  it('have no comment where they use no files, or too many', () => {
    expect(writeCopied(fragment, { ...origin, files: {} })).toBe('<Turn speed="0.4"/>\n');
    const many = Object.fromEntries(Array.from({ length: 501 }, (_, n) => [`actions/A${n}.py`, '']));
    expect(writeCopied(fragment, { ...origin, files: many })).not.toContain('<!--');
    expect(
      writeCopied(fragment, { ...origin, files: { 'actions/A.py': 'x'.repeat(8_000_000) } }),
    ).not.toContain('<!--');
  });
});

describe('a text from elsewhere', () => {
  it('is XML, with no files', () => {
    expect(readCopied('<Sleep msec="5"/><!-- a note -->')).toMatchObject({ origin: null, isDamaged: false });
    expect(readCopied('some words')).toBeNull();
  });

  it.each([
    ['a path outside', { '../evil.py': '' }],
    ['an absolute path', { '/etc/passwd': '' }],
    ['a folder in the name of an action', { 'actions/a/b.py': '' }],
    ['an action that is no Python name', { 'actions/a-b.py': '' }],
    ['a keyword', { 'actions/class.py': '' }],
    ['another kind of file', { 'launch/x.launch.py': '' }],
    ['the settings', { 'project.json': '{}' }],
    ['a tree that is none', { 'trees/Dock.json': '{}' }],
    ['a tree with a name that is no file name', { 'trees/a:b.json': tree }],
    ['a hidden name', { 'trees/..json': tree }],
    ['a long name', { [`actions/${'a'.repeat(201)}.py`]: '' }],
    ['a content that is no text', { 'actions/Turn.py': 5 }],
    ['a binary text', { 'actions/Turn.py': 'a\0b' }],
    ['a large action', { 'actions/Turn.py': 'x'.repeat(2_000_001) }],
    ['names that differ in capitals only', { 'actions/Turn.py': '', 'actions/turn.py': '' }],
  ])('is not trusted: %s', (_, files) => {
    expect(readCopied(withFiles(files))).toMatchObject({ origin: null, isDamaged: true });
  });

  it.each([
    ['another version', (document: Record<string, unknown>) => (document['version'] = 2)],
    ['no project', (document: Record<string, unknown>) => delete document['project']],
    ['files that are a list', (document: Record<string, unknown>) => (document['files'] = [])],
    ['no files', (document: Record<string, unknown>) => (document['files'] = null)],
  ])('is not understood: %s', (_, change) => {
    expect(readCopied(withJson(change))).toMatchObject({ origin: null, isDamaged: true });
  });

  it('has its blocks even if the rest is broken', () => {
    const copied = readCopied('<Turn/>\n<!-- {"format":"bt-studio/blocks",oops} -->');
    expect(copied?.fragment.tops).toHaveLength(1);
    expect(copied?.isDamaged).toBe(true);
  });
});
