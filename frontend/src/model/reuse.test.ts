import { describe, expect, it } from 'vitest';
import { parseDiagram, serializeDiagram } from './serialize';
import { atPlaces, closureOf, planInsertion } from './reuse';

const tree = (id: string, nodes: object) =>
  serializeDiagram(
    parseDiagram({ format: 'bt-studio/diagram', version: 1, id, root: 'n1', nodes, drafts: [] }),
  );

const files = {
  'trees/Dock.json': tree('Dock', {
    n1: { type: 'Sequence', children: ['n2', 'n3'] },
    n2: { type: 'SubTree', tree: 'Search' },
    n3: { type: 'Creep' },
  }),
  'trees/Search.json': tree('Search', { n1: { type: 'Turn' } }),
  'trees/Other.json': tree('Other', { n1: { type: 'Wave' } }),
  'actions/Creep.py': 'class Creep(Base):\n    """Creep."""\n',
  'actions/Turn.py': 'class Turn(Base):\n    pass\n',
  'actions/Wave.py': 'class Wave(Base):\n    pass\n',
};

const nothing = () => null;
const free = () => false;

describe('reuse', () => {
  it('copies the files that a tree needs, and no others', () => {
    expect(Object.keys(closureOf('Dock', files)).sort()).toEqual([
      'actions/Creep.py',
      'actions/Turn.py',
      'trees/Dock.json',
      'trees/Search.json',
    ]);
  });

  it('keeps names that are free', () => {
    const plan = planInsertion('Dock', closureOf('Dock', files), nothing, free);
    expect(plan.tree).toBe('Dock');
    expect(plan.files).toEqual(closureOf('Dock', files));
  });

  it('reuses identical existing files', () => {
    const existing = (path: string) => (files as Record<string, string>)[path] ?? null;
    const plan = planInsertion('Dock', closureOf('Dock', files), existing, free);
    expect(plan.files).toEqual({});
    expect(plan.tree).toBe('Dock');
  });

  it('renames a new file whose name is taken, and all references to it', () => {
    const project: Record<string, string> = {
      'actions/Turn.py': 'class Turn(Base):\n    mine = True\n',
      'trees/Search.json': files['trees/Search.json'],
    };
    const taken = new Set(['Turn', 'Turn2']);
    const plan = planInsertion(
      'Dock',
      closureOf('Dock', files),
      (path) => project[path] ?? null,
      (name) => taken.has(name),
    );
    expect(Object.keys(plan.files).sort()).toEqual([
      'actions/Creep.py',
      'actions/Turn3.py',
      'trees/Dock.json',
      'trees/Search2.json',
    ]);
    expect(plan.files['actions/Turn3.py']).toContain('class Turn3(Base)');
    expect(parseDiagram(plan.files['trees/Search2.json']).nodes['n1']?.type).toBe('Turn3');
    expect(parseDiagram(plan.files['trees/Search2.json']).id).toBe('Search2');
    expect(parseDiagram(plan.files['trees/Dock.json']).nodes['n2']?.tree).toBe('Search2');
    expect(plan.places['actions/Turn.py']).toBe('actions/Turn3.py');
    expect(atPlaces(closureOf('Dock', files), plan.places)).toMatchObject(plan.files);
  });
});
