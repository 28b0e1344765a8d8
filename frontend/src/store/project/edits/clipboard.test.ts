import { beforeEach, describe, expect, it } from 'vitest';
import { closeArrivals, useArrivals } from '@/store/dialogs/arrivals';
import { planHere } from '@/store/project/bringing';
import { useProjectStore } from '@/store/project';
import { openProject } from '../../../../harness/testing';
import { clipboardText, copyTree, pasteText, selectedBlocks, textOf } from './clipboard';

function copiedText(): string | null {
  const blocks = selectedBlocks();
  return blocks && textOf(blocks);
}

const store = () => useProjectStore.getState();
const blocks = () => Object.values(store().diagrams['Main']?.nodes ?? {});

const SOURCE = {
  trees: {
    Main: {
      r: { type: 'Sequence', children: ['t', 's'] },
      t: { type: 'Turn' },
      s: { type: 'SubTree', tree: 'Dock' },
    },
    Dock: { n: { type: 'Creep' } },
  },
  texts: {
    'actions/Turn.py': 'class Turn: theirs',
    'actions/Creep.py': 'class Creep: ...',
    'actions/Unused.py': 'class Unused: ...',
  },
  selected: ['r'],
};

/** Copies the tree of the first project, and opens another one. */
function carried(texts: Record<string, string> = {}): string {
  openProject(SOURCE);
  const text = copiedText() ?? '';
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts, selected: ['r'] });
  useProjectStore.setState({ projectId: 'p2' });
  return text;
}

const press = () => {
  const { arrivals } = useArrivals.getState();
  if (!arrivals) throw new Error('Nothing is asked.');
  closeArrivals();
  arrivals.take(planHere(arrivals));
};

beforeEach(closeArrivals);

describe('blocks of another project', () => {
  it('bring their actions and trees after a look, in one step', () => {
    expect(pasteText(carried())).toBe('blocks');
    expect(blocks()).toHaveLength(1);
    const { arrivals } = useArrivals.getState();
    expect(arrivals?.name).toBe('Test');
    expect(Object.keys(arrivals?.sources ?? {}).sort()).toEqual([
      'actions/Creep.py',
      'actions/Turn.py',
      'trees/Dock.json',
    ]);
    press();
    expect(blocks().map(({ type }) => type)).toEqual(['Sequence', 'Sequence', 'Turn', 'SubTree']);
    expect(store().currentText('actions/Creep.py')).toBe('class Creep: ...');
    expect(Object.keys(store().diagrams)).toEqual(['Main', 'Dock']);
    store().undo();
    expect(store().pendingChanges()).toEqual([]);
    expect(blocks()).toHaveLength(1);
    store().redo();
    expect(blocks()).toHaveLength(4);
    expect(store().currentText('actions/Turn.py')).toBe('class Turn: theirs');
  });

  it('use the new name of a file whose name is taken', () => {
    pasteText(carried({ 'actions/Turn.py': 'class Turn: mine' }));
    press();
    expect(blocks().map(({ type }) => type)).toContain('Turn2');
    expect(store().currentText('actions/Turn2.py')).toBe('class Turn2: theirs');
  });

  it('need no look where all that they use is here', () => {
    const text = carried();
    pasteText(text);
    press();
    pasteText(text);
    expect(useArrivals.getState().arrivals).toBeNull();
    expect(blocks()).toHaveLength(7);
  });

  it('ask nothing of somebody who may only read', () => {
    const text = carried();
    useProjectStore.setState({ role: 'viewer' });
    pasteText(text);
    expect(useArrivals.getState().arrivals).toBeNull();
    expect(blocks()).toHaveLength(1);
    expect(store().refusedEdits).toBe(1);
  });
});

it('pastes within the project without a look', () => {
  openProject(SOURCE);
  pasteText(copiedText() ?? '');
  expect(useArrivals.getState().arrivals).toBeNull();
  expect(blocks()).toHaveLength(6);
});

it('pastes XML from elsewhere, and only the blocks of a text that is damaged', () => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, selected: ['r'] });
  expect(pasteText('<Turn/>')).toBe('blocks');
  expect(pasteText('<Turn/>\n<!-- {"format":"bt-studio/blocks",oops} -->')).toBe('damaged');
  expect(blocks()).toHaveLength(3);
  expect(pasteText('words')).toBe('nothing');
});

it('copies a tree as a block that calls it, with all that it uses', async () => {
  openProject(SOURCE);
  await copyTree('Dock');
  const text = await clipboardText();
  expect(text).toContain('<SubTree ID="Dock"/>');
  expect(text).toContain('actions/Creep.py');
  expect(text).not.toContain('actions/Turn.py');
});
