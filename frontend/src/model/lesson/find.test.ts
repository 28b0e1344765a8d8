import { describe, expect, it } from 'vitest';
import type { Diagram } from '../diagram';
import { findBlock, lessonPath } from './find';

const tree = (id: string, nodes: Diagram['nodes']): Diagram => ({
  format: 'bt-studio/diagram',
  version: 1,
  id,
  root: Object.keys(nodes)[0] ?? null,
  nodes,
  drafts: [],
  layout: 'vertical',
});

const diagrams = {
  Dock: tree('Dock', { d: { type: 'Turn', name: 'look' } }),
  Main: tree('Main', {
    r: { type: 'Sequence', name: 'Turn', children: ['a', 'b'] },
    a: { type: 'Go' },
    b: { type: 'Go', name: 'back' },
  }),
};

describe('findBlock', () => {
  it.each([
    ['back', { tree: 'Main', node: 'b' }],
    ['Go', { tree: 'Main', node: 'a' }],
    ['look', { tree: 'Dock', node: 'd' }],
    ['Turn', { tree: 'Main', node: 'r' }],
    ['gone', null],
  ])('finds %s', (wanted, found) => {
    expect(findBlock(diagrams, 'Main', wanted)).toEqual(found);
  });
});

describe('lessonPath', () => {
  const paths = ['project.json', 'lessons/en.md', 'lessons/es.md'];
  it.each([
    [paths, 'es', 'lessons/es.md'],
    [paths, 'fr', 'lessons/en.md'],
    [['lessons/de.md'], 'es', 'lessons/de.md'],
    [['lessons/deep/en.md', 'README.md'], 'en', null],
  ])('chooses from %j in %s', (files, language, path) => {
    expect(lessonPath(files, language)).toBe(path);
  });
});
