import type { Attached, AttachedTree } from '@/generated/messages';

/** The tree of a program: one action below a Sequence. */
export const attachedTree: AttachedTree = {
  name: 'Main · robot:1667',
  main_tree: 'Main',
  files: {
    'project.json': JSON.stringify({ format: 'bt-studio/project', version: 1, name: 'x', main_tree: 'Main' }),
    'trees/Main.json': JSON.stringify({
      format: 'bt-studio/diagram',
      version: 1,
      id: 'Main',
      root: 'u1',
      nodes: { u1: { type: 'Sequence', children: ['u2'] }, u2: { type: 'Sleep', ports: { msec: '5' } } },
      drafts: [],
    }),
  },
  actions: [],
  xml: '<root BTCPP_format="4"/>',
};

/** A program as the session tells of it. */
export const attached = (more: Partial<Attached> = {}): Attached => ({
  address: 'robot:1667',
  state: 'following',
  age_s: 0.05,
  dropped: 0,
  controls: false,
  problem: '',
  ...more,
});
