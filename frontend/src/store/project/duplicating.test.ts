import { beforeEach, describe, expect, it } from 'vitest';
import { openProject } from '../../../harness/testing';
import { useProjectStore } from '.';
import { canDuplicate, duplicateDocument } from './duplicating';

const store = () => useProjectStore.getState();

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence' } } },
    texts: {
      'actions/Turn.py': 'import x\n\n\nclass Turn(Base):\n    name = "Turn"\n',
      'robots/mine/robot.yaml': 'name: mine\n',
      'notes/README.md': 'Hello',
    },
  });
});

describe('duplicateDocument', () => {
  it('gives a tree a new id', () => {
    expect(duplicateDocument('trees/Main.json')).toBe('trees/Main_copy.json');
    expect(store().diagrams['Main_copy']).toMatchObject({
      id: 'Main_copy',
      nodes: { r: { type: 'Sequence' } },
    });
    expect(duplicateDocument('trees/Main.json')).toBe('trees/Main_copy2.json');
  });

  it('gives an action a new class, and keeps the rest', () => {
    expect(duplicateDocument('actions/Turn.py')).toBe('actions/Turn_copy.py');
    expect(store().currentText('actions/Turn_copy.py')).toContain(
      'class Turn_copy(Base):\n    name = "Turn"',
    );
  });

  it('copies any other text as it is', () => {
    expect(duplicateDocument('notes/README.md')).toBe('notes/README_copy.md');
    expect(store().currentText('notes/README_copy.md')).toBe('Hello');
  });

  it('does not copy robots, which are several files, and missing files', () => {
    expect(['robots/mine/robot.yaml', 'mesh.stl', 'notes/README.md'].map(canDuplicate)).toEqual([
      false,
      false,
      true,
    ]);
    expect(duplicateDocument('robots/mine/robot.yaml')).toBeNull();
  });
});
