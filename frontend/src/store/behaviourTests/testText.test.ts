import { describe, expect, it } from 'vitest';
import { parse } from 'yaml';
import type { Draft } from './fromStory';
import { expectations, flow, linesOf, namesIn, withTest, type Chosen } from './testText';

const draft: Draft = {
  tree: 'Main',
  tickHz: 20,
  ticks: 3,
  repeat: true,
  blackboard: { speed: 0.3, 'a:b': 'yes' },
  doubles: [
    [
      'See',
      [
        { at: 1, status: 'SUCCESS', outputs: { offset: 1e-7 } },
        { at: 3, status: 'FAILURE', outputs: {} },
      ],
    ],
    ['Turn::3', [{ at: 2, status: 'RUNNING', outputs: {} }]],
    ['Mine', 'real'],
  ],
  root: 'RUNNING',
  statuses: [['Turn::3', 'RUNNING']],
  results: [['See', 'FAILURE']],
  idle: ['Other'],
  values: { done: true, seen: [1, 2] },
  notes: [],
};
const all: Chosen = { name: 'at: "once"', root: true, statuses: true, idle: true, keys: ['done', 'gone'] };

describe('linesOf', () => {
  it('writes a test that is read as what was meant', () => {
    const { text } = withTest(null, linesOf(draft, all));
    expect(parse(text)).toEqual({
      format: 'bt-studio/test',
      version: 1,
      tests: [
        {
          name: 'at: "once"',
          tree: 'Main',
          blackboard: { speed: 0.3, 'a:b': 'yes' },
          doubles: {
            See: [
              { at: 1, status: 'SUCCESS', outputs: { offset: 1e-7 } },
              { at: 3, status: 'FAILURE' },
            ],
            'Turn::3': 'RUNNING',
            Mine: 'real',
          },
          tick_hz: 20,
          ticks: 3,
          repeat: true,
          expect: [
            { at: 'end', root: 'RUNNING' },
            { at: 'end', node: 'Turn::3', status: 'RUNNING' },
            { at: 'end', node: 'See', result: 'FAILURE' },
            { at: 'end', node: 'Other', status: 'IDLE' },
            { at: 'end', blackboard: { done: true } },
          ],
        },
      ],
    });
  });

  it('expects what was chosen alone', () => {
    const none = { ...all, root: false, statuses: false, idle: false, keys: [] };
    expect(expectations(draft, none)).toEqual([]);
    expect(expectations(draft, { ...none, keys: ['seen'] })).toEqual([{ blackboard: { seen: [1, 2] } }]);
    expect(expectations({ ...draft, root: null }, { ...none, root: true })).toEqual([]);
  });
});

it.each([
  ['plain text', 'plain text'],
  ['on', '"on"'],
  ['', '""'],
  ['a: b', '"a: b"'],
  [1e-7, '1.0e-7'],
  [1.5e-7, '1.5e-7'],
  [-2e30, '-2.0e+30'],
  [[1, 'x', true], '[1, x, true]'],
])('writes %j as YAML of both versions', (value, text) => {
  expect(flow(value)).toBe(text);
  expect(parse(text)).toEqual(value);
});

describe('withTest', () => {
  const lines = ['name: new', 'ticks: 1'];

  it.each([
    'tests:\n  - name: a # first\n    ticks: 2\n',
    'tests:\n- name: a\n  ticks: 2',
    'tests:\n  - name: a\n    ticks: 2\n\n# the end\n',
    'tests:\n  - {name: a, ticks: 2}\nformat: x\n',
  ])('adds to %j and leaves its lines', (text) => {
    const made = withTest(text, lines);
    const read = parse(made.text) as { tests: object[] };
    expect(read.tests).toEqual([
      { name: 'a', ticks: 2 },
      { name: 'new', ticks: 1 },
    ]);
    for (const line of text.split('\n')) expect(made.text.split('\n')).toContain(line);
    expect(made.text.split('\n')[made.line - 1]).toMatch(/- name: new$/);
  });

  it('begins a file', () => {
    expect(withTest('', lines)).toEqual(withTest(null, lines));
    expect(withTest(null, lines).text.split('\n')[3]).toBe('  - name: new');
  });

  it('knows the names in a file, and files that cannot take one more', () => {
    expect(namesIn('tests:\n  - name: a\n  - name: b\n')).toEqual(['a', 'b']);
    for (const bad of ['tests: [', 'tests: []', 'tests: [{name: a}]', 'a: 1', '- 1'])
      expect(namesIn(bad)).toBeNull();
    expect(() => withTest('a: 1', lines)).toThrow('no list of tests');
  });
});
