import type { ActionModel, ProjectDetail } from '@/api/types';
import { projectDetail, projectFile } from '@/store/testing';
import bumpAndGo from '../../examples/laser_bump_and_go/trees/MainTree.json';

const port = (name: string, type: string, value: string, direction: 'input' | 'output' = 'input') => ({
  name,
  type,
  direction,
  default: value,
  required: false,
  description: `${name} of the action.`,
});

const action = (
  name: string,
  kind: string,
  doc: string,
  ports: ActionModel['ports'],
  open = false,
): ActionModel => ({
  name,
  kind,
  doc,
  ports,
  open,
  path: `actions/${name}.py`,
  line: 1,
  imports: [],
  diagnostics: [],
});

export const actions: ActionModel[] = [
  action('CheckObstacle', 'Condition', 'Succeeds if the LIDAR sees something near, ahead of the robot.', [
    port('obs_dist', 'float', '1.0'),
    port('amplitude', 'float', '30.0'),
  ]),
  action('Turn', 'Action', 'Turns on the spot.', [port('ang_speed', 'float', '0.6')]),
  action('Forward', 'Action', 'Drives ahead.', [port('lin_speed', 'float', '0.3')]),
  action('Legacy', 'Action', '', [], true),
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
  const files = trees.map(([id, tree]) => projectFile(`trees/${id}.json`, 1, JSON.stringify(tree)));
  return { ...projectDetail(1, files), name: 'Laser bump and go', universe: 'walled_room', actions };
}
