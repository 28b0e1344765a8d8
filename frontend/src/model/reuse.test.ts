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
const DOCK = 'trees/Dock.json';
const dock = closureOf([DOCK], files);

describe('reuse', () => {
  it('takes what a tree needs, and no more', () => {
    expect(Object.keys(dock).sort()).toEqual([
      'actions/Creep.py',
      'actions/Turn.py',
      'trees/Dock.json',
      'trees/Search.json',
    ]);
  });

  it('leaves names alone where they are free', () => {
    const plan = planInsertion({ needs: [DOCK], sources: dock, existing: nothing, isTaken: free });
    expect(plan.arrivals.map(({ state }) => state)).toEqual(['new', 'new', 'new', 'new']);
    expect(plan.files).toEqual(dock);
  });

  it('reuses identical existing files', () => {
    const existing = (path: string) => (files as Record<string, string>)[path] ?? null;
    const plan = planInsertion({ needs: [DOCK], sources: dock, existing, isTaken: free });
    expect(plan.files).toEqual({});
    expect(plan.places[DOCK]).toBe(DOCK);
    expect(plan.arrivals.every(({ state }) => state === 'same')).toBe(true);
  });

  it('renames a new file whose name is taken, and all references to it', () => {
    const project: Record<string, string> = {
      'actions/Turn.py': 'class Turn(Base):\n    mine = True\n',
      'trees/Search.json': files['trees/Search.json'],
    };
    const taken = new Set(['Turn', 'Turn2']);
    const plan = planInsertion({
      needs: [DOCK],
      sources: dock,
      existing: (path) => project[path] ?? null,
      isTaken: (name) => taken.has(name),
    });
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
    expect(atPlaces(dock, plan.places)).toMatchObject(plan.files);
  });

  describe('of a newcomer whose name is taken', () => {
    const mine: Record<string, string> = {
      'actions/Turn.py': 'class Turn(Base):\n    mine = True\n',
      'trees/Search.json': tree('Search', { n1: { type: 'Wait' } }),
    };
    const plan = (choices: Record<string, 'keep' | 'rename' | 'replace'>) =>
      planInsertion({
        needs: [DOCK],
        sources: dock,
        existing: (path) => mine[path] ?? null,
        isTaken: (name) => ['Turn', 'Search'].includes(name),
        choices,
      });

    it('takes the own one, and nothing that only the other one uses', () => {
      const { arrivals, files: written, places } = plan({ 'trees/Search.json': 'keep' });
      expect(arrivals.map(({ path, state }) => [path, state])).toEqual([
        [DOCK, 'new'],
        ['trees/Search.json', 'keep'],
        ['actions/Creep.py', 'new'],
      ]);
      expect(Object.keys(written).sort()).toEqual(['actions/Creep.py', DOCK]);
      expect(places['trees/Search.json']).toBe('trees/Search.json');
      expect(parseDiagram(written[DOCK]).nodes['n2']?.tree).toBe('Search');
    });

    it('replaces the own one', () => {
      const { arrivals, files: written } = plan({
        'trees/Search.json': 'replace',
        'actions/Turn.py': 'replace',
      });
      expect(arrivals.map(({ state }) => state)).toEqual(['new', 'replace', 'new', 'replace']);
      expect(written['actions/Turn.py']).toBe(files['actions/Turn.py']);
      expect(written['trees/Search.json']).toBe(files['trees/Search.json']);
    });

    it('says the new names', () => {
      const { arrivals } = plan({});
      expect(arrivals.filter(({ state }) => state === 'rename').map(({ place }) => place)).toEqual([
        'trees/Search2.json',
        'actions/Turn2.py',
      ]);
    });
  });

  it('brings the actions that an action imports, and renames them there', () => {
    const project = {
      'actions/Go.py': 'from Wheels import Wheels\n\nclass Go(Wheels): ...\n',
      'actions/Wheels.py': 'class Wheels: ...\n',
      'actions/Arm.py': 'class Arm: ...\n',
    };
    const sources = closureOf(['actions/Go.py'], project);
    expect(Object.keys(sources)).toEqual(['actions/Go.py', 'actions/Wheels.py']);
    const { files: written } = planInsertion({
      needs: ['actions/Go.py'],
      sources,
      existing: (path) => (path === 'actions/Wheels.py' ? 'class Wheels: mine\n' : null),
      isTaken: free,
    });
    expect(written).toEqual({
      'actions/Go.py': 'from Wheels2 import Wheels2\n\nclass Go(Wheels2): ...\n',
      'actions/Wheels2.py': 'class Wheels2: ...\n',
    });
  });

  it('gives no name that another newcomer has', () => {
    const sources = {
      'actions/Turn.py': 'class Turn(Turn2): theirs',
      'actions/Turn2.py': 'class Turn2: ...',
    };
    const { places } = planInsertion({
      needs: Object.keys(sources),
      sources,
      existing: (path) => (path === 'actions/Turn.py' ? 'class Turn: mine' : null),
      isTaken: (name) => name === 'Turn',
    });
    expect(places['actions/Turn.py']).toBe('actions/Turn3.py');
  });
});
