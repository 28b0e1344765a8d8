import { describe, expect, it } from 'vitest';
import type { TreeNode } from '@/generated/messages';
import catalog from '@catalog';
import { emptyDiagram, type DiagramNode } from '@/model/diagram';
import { makeVocabulary, readCatalog } from '@/model/vocabulary';
import type { Story, StoryTick } from '@/store/recording/story';
import type { Write } from '@/store/recording/steps';
import { action, port } from '../../../harness/testing';
import { draftOf } from './fromStory';

const vocabulary = makeVocabulary(readCatalog(catalog), [
  action('See', { kind: 'Condition', ports: [port('offset', 'double', { direction: 'output' })] }),
  action('Turn', { ports: [] }),
  action('Mine', { kind: 'Decorator' }),
]);

const NODES: Readonly<Record<string, DiagramNode>> = {
  r: { type: 'Sequence', children: ['a', 'b'] },
  a: { type: 'See', ports: { offset: '{seen}' } },
  b: { type: 'Turn' },
};
const diagrams = { Main: { ...emptyDiagram('Main'), root: 'r', nodes: NODES } };
const project = { diagrams, vocabulary, tickHz: 20 };

const node = (uid: number, type: string, kind: string, more: Partial<TreeNode> = {}): TreeNode => ({
  ...{ uid, parent: uid > 1 ? 1 : 0, type, kind, name: type, path: `${type}::${uid}`, tree_id: 'Main' },
  node_id: ['', 'r', 'a', 'b'][uid] ?? 'gone',
  ...more,
});
const nodes = [node(1, 'Sequence', 'Control'), node(2, 'See', 'Condition'), node(3, 'Turn', 'Action')];

const tick = (number: number, more: Partial<StoryTick> = {}): StoryTick => ({
  number,
  t: number / 20,
  changed: [],
  flashed: [],
  writes: [],
  ...more,
});
const write = (key: string, value: unknown, writer: number, more: Partial<Write> = {}): Write => ({
  ...{ scope: '', key, type: 'double', value, writer, isPreview: false, isRemoved: false },
  ...more,
});
const story = (ticks: StoryTick[], more: Partial<Story> = {}): Story => ({
  nodes,
  statuses: [],
  entries: [],
  ticks,
  isWhole: true,
  ...more,
});
const kinds = (made: ReturnType<typeof draftOf>) => made.notes.map(({ kind }) => kind);

describe('the doubles', () => {
  it('return what the leaves returned, from each tick on', () => {
    const made = draftOf(
      story([
        tick(1, {
          changed: [
            [1, 'RUNNING'],
            [2, 'SUCCESS'],
            [3, 'RUNNING'],
          ],
          writes: [write('seen', 0.5, 2)],
        }),
        tick(2),
        tick(3, { changed: [[3, 'IDLE']], flashed: [[2, 'FAILURE']] }),
      ]),
      project,
    );
    expect(made.doubles).toEqual([
      [
        'See',
        [
          { at: 1, status: 'SUCCESS', outputs: { offset: 0.5 } },
          { at: 2, status: 'SUCCESS', outputs: {} },
          { at: 3, status: 'FAILURE', outputs: {} },
          { at: 3, status: 'SUCCESS', outputs: {} },
        ],
      ],
      ['Turn', [{ at: 1, status: 'RUNNING', outputs: {} }]],
    ]);
    expect(made.notes).toEqual([]);
  });

  it('leave out leaves that were never ticked', () => {
    expect(draftOf(story([tick(1, { changed: [[1, 'RUNNING']] })]), project).doubles).toEqual([]);
  });

  it('have exact paths where a name means several', () => {
    const twice = [node(1, 'Sequence', 'Control'), node(2, 'Turn', 'Action'), node(3, 'Turn', 'Action')];
    const made = draftOf(
      story(
        [
          tick(1, {
            changed: [
              [1, 'RUNNING'],
              [2, 'SUCCESS'],
              [3, 'RUNNING'],
            ],
          }),
        ],
        { nodes: twice },
      ),
      project,
    );
    expect(made.doubles.map(([name]) => name)).toEqual(['Turn::2', 'Turn::3']);
  });

  it('leave an own control node to its Python, and say so', () => {
    const own = [node(1, 'Mine', 'Decorator'), node(2, 'See', 'Condition')];
    const made = draftOf(
      story(
        [
          tick(1, {
            changed: [
              [1, 'SUCCESS'],
              [2, 'SUCCESS'],
            ],
          }),
        ],
        { nodes: own },
      ),
      project,
    );
    expect(made.doubles.at(-1)).toEqual(['Mine', 'real']);
    expect(kinds(made)).toEqual(['python']);
  });
});

describe('the values', () => {
  it('go to ports of shared trees through the ports of the SubTree', () => {
    const trees = {
      Main: {
        ...emptyDiagram('Main'),
        root: 's',
        nodes: { s: { type: 'SubTree', tree: 'Sub', ports: { seen: '{far}' } } },
      },
      Sub: { ...emptyDiagram('Sub'), root: 'a', nodes: { a: NODES['a']! } },
    };
    const inner = [
      node(1, 'SubTree', 'SubTree', { path: 'Sub::1', node_id: 's' }),
      node(2, 'See', 'Condition', { tree_id: 'Sub' }),
    ];
    const ticks = [
      tick(1, {
        changed: [
          [1, 'SUCCESS'],
          [2, 'SUCCESS'],
        ],
        writes: [write('far', 3, 2)],
      }),
    ];
    const made = draftOf(story(ticks, { nodes: inner }), { ...project, diagrams: trees });
    expect(made.doubles).toEqual([['See', [{ at: 1, status: 'SUCCESS', outputs: { offset: 3 } }]]]);
  });

  it('that a test cannot repeat are named', () => {
    const made = draftOf(
      story([
        tick(1, {
          changed: [
            [1, 'RUNNING'],
            [2, 'SUCCESS'],
          ],
          writes: [write('seen', 'lon', 2, { isPreview: true })],
        }),
        tick(2, { writes: [write('seen', { x: 1 }, 2), write('other', 1, 3), write('set', 1, 0)] }),
      ]),
      project,
    );
    expect(made.notes).toEqual([
      { kind: 'value', key: 'seen', node: 'See' },
      { kind: 'outside', key: 'set' },
    ]);
    expect(
      kinds(
        draftOf(
          story([
            tick(1, {
              changed: [
                [2, 'SUCCESS'],
                [1, 'RUNNING'],
              ],
              writes: [write('own', 1, 2)],
            }),
          ]),
          project,
        ),
      ),
    ).toEqual(['notPort']);
  });

  it('of the begin are on the blackboard, and those of the end can be expected', () => {
    const made = draftOf(
      story(
        [
          tick(1, {
            changed: [
              [1, 'RUNNING'],
              [2, 'SUCCESS'],
            ],
            writes: [write('speed', 0.3, 0), write('in', 1, 0, { scope: 'Sub::1' })],
          }),
          tick(2, { writes: [write('seen', 2, 2), write('speed', 1, 2, { isRemoved: true })] }),
        ],
        { entries: [{ scope: '', key: 'kept', type: 'string', value: 'a', isPreview: false }] },
      ),
      project,
    );
    expect(made.blackboard).toEqual({ kept: 'a', speed: 0.3 });
    expect(made.values).toEqual({ kept: 'a', seen: 2 });
  });
});

describe('the run', () => {
  const running = { changed: [[1, 'RUNNING']] } as const;

  it('tells the root, what stayed, what did not, and what is idle', () => {
    const made = draftOf(
      story([
        tick(1, {
          changed: [
            [1, 'RUNNING'],
            [3, 'RUNNING'],
          ],
          flashed: [[2, 'SUCCESS']],
        }),
      ]),
      project,
    );
    expect(made).toMatchObject({ tree: 'Main', ticks: 1, tickHz: 20, repeat: false, root: 'RUNNING' });
    expect([made.statuses, made.results, made.idle]).toEqual([
      [['Turn', 'RUNNING']],
      [['See', 'SUCCESS']],
      [],
    ]);
  });

  it('continues after a root that has ended', () => {
    const done = tick(1, { flashed: [[1, 'SUCCESS']] });
    expect(draftOf(story([done, tick(2, running)]), project)).toMatchObject({
      repeat: true,
      root: 'RUNNING',
    });
    expect(draftOf(story([done]), project)).toMatchObject({ repeat: false, root: 'SUCCESS' });
  });

  it('goes back as far as is wanted, and says what was running then', () => {
    const ticks = [tick(1, { ...running, writes: [write('seen', 1, 2)] }), tick(2), tick(3)];
    const made = draftOf(story(ticks), project, 2);
    expect(made).toMatchObject({ ticks: 2, blackboard: { seen: 1 } });
    expect(kinds(made)).toEqual(['midway']);
  });

  it('names a gap, an exception, a changed tree and irregular ticks', () => {
    expect(kinds(draftOf(story([tick(7, running)], { isWhole: false }), project))).toEqual(['gap']);
    expect(kinds(draftOf(story([tick(1)]), project))).toEqual(['raised']);
    const gone = [...nodes, node(4, 'Turn', 'Action')];
    expect(kinds(draftOf(story([tick(1, running)], { nodes: gone }), project))).toEqual(['changed']);
    const late = [1, 2, 3, 9, 10].map((at) => tick(at, at === 1 ? running : {}));
    expect(kinds(draftOf(story(late), project))).toEqual(['irregular']);
  });

  it('has the rate of the project, or the one at which the ticks came', () => {
    const at = (hz: number) => [1, 2, 3].map((number) => tick(number, { ...running, t: number / hz }));
    expect(draftOf(story(at(20.1)), project).tickHz).toBe(20);
    expect(draftOf(story(at(10)), project).tickHz).toBe(10);
  });
});
