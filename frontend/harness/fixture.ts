import type { ActionModel, ProjectDetail, ProjectFile } from '@/api/types';
import bumpAndGo from '../../examples/laser_bump_and_go/trees/MainTree.json';

const port = (name: string, type: string, value: string, direction: 'input' | 'output' = 'input') => ({
  name,
  type,
  direction,
  default: value,
  required: false,
  description: `${name} of the action.`,
});

export const actions: ActionModel[] = [
  {
    name: 'CheckObstacle',
    kind: 'Condition',
    open: false,
    doc: 'Succeeds if the LIDAR sees something near, ahead of the robot.',
    ports: [port('obs_dist', 'float', '1.0'), port('amplitude', 'float', '30.0')],
  },
  {
    name: 'Turn',
    kind: 'Action',
    open: false,
    doc: 'Turns on the spot.',
    ports: [port('ang_speed', 'float', '0.6')],
  },
  {
    name: 'Forward',
    kind: 'Action',
    open: false,
    doc: 'Drives ahead.',
    ports: [port('lin_speed', 'float', '0.3')],
  },
  { name: 'Legacy', kind: 'Action', open: true, doc: '', ports: [] },
];

/** A tree that shows one of everything, mistakes included. */
export const zoo = {
  format: 'bt-studio/diagram',
  version: 1,
  id: 'Zoo',
  root: 'r',
  nodes: {
    r: { type: 'Fallback', name: 'patrol and dock', children: ['p', 's', 'w', 'x'] },
    p: { type: 'Parallel', ports: { success_count: '1' }, children: ['c', 'd'] },
    c: {
      type: 'CheckObstacle',
      ports: { obs_dist: '{limit}', amplitude: '30' },
      conditions: { _skipIf: 'docked' },
    },
    d: { type: 'Delay', ports: { delay_msec: '500' }, children: ['f'] },
    f: { type: 'Forward', name: 'drive to the door', ports: { lin_speed: '0.3' }, comment: 'slow' },
    s: { type: 'SequenceWithMemory', children: ['rp', 't2'] },
    rp: { type: 'Repeat', children: ['t'] },
    t: { type: 'Turn', ports: { ang_speed: '{' } },
    t2: { type: 'SubTree', tree: 'MainTree', ports: { target: '{goal}' } },
    w: { type: 'IfThenElse', disabled: true, children: ['sc', 'f2'] },
    sc: { type: 'ScriptCondition', ports: { code: 'battery < 20' } },
    f2: { type: 'Legacy', ports: { goal: '{goal}', label: 'home' }, color: '#b45309' },
    x: { type: 'Grasp', name: 'pick it up' },
    q: { type: 'Inverter', children: ['q2'] },
    q2: { type: 'Turn' },
  },
  drafts: ['q'],
  layout: 'vertical',
};

/** A tree of about `count` blocks, for measuring. */
export function large(count: number): unknown {
  const nodes: Record<string, unknown> = {};
  let made = 0;
  const grow = (depth: number): string => {
    const id = `n${(made += 1)}`;
    const children: string[] = [];
    for (let i = 0; i < 4 && depth < 6 && made < count; i += 1) children.push(grow(depth + 1));
    nodes[id] =
      children.length > 0
        ? { type: depth % 2 ? 'Sequence' : 'Fallback', name: `step ${id}`, children }
        : { type: 'Forward', ports: { lin_speed: '0.3' } };
    return id;
  };
  const root = grow(0);
  return {
    format: 'bt-studio/diagram',
    version: 1,
    id: 'Large',
    root,
    nodes,
    drafts: [],
    layout: 'vertical',
  };
}

export function fixture(count: number): ProjectDetail {
  const trees: [string, unknown][] = [
    ['MainTree', bumpAndGo],
    ['Zoo', zoo],
    ['Large', large(count)],
    ['Empty', { format: 'bt-studio/diagram', version: 1, id: 'Empty', root: null, nodes: {}, drafts: [] }],
  ];
  const files: ProjectFile[] = trees.map(([id, tree]) => ({
    path: `trees/${id}.json`,
    revision: 1,
    size: 0,
    sha256: '',
    content: JSON.stringify(tree),
  }));
  return {
    id: 'p1',
    name: 'Laser bump and go',
    description: '',
    main_tree: 'MainTree',
    universe: 'walled_room',
    revision: 1,
    created_at: '',
    updated_at: '',
    root_diagram: null,
    settings: { name: 'Laser bump and go', main_tree: 'MainTree' },
    files,
    actions,
    diagnostics: [],
  };
}
