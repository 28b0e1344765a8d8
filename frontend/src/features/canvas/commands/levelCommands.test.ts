import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openDiagram } from '../../../../harness/canvas';
import { nodeOf } from '../../../../harness/testing';
import { showsTree } from '../view/views';
import { levelCommands } from './levelCommands';

const fitView = vi.fn();
const command = (id: string) => levelCommands.find((each) => each.id === `canvas.${id}`)!;

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['f'] },
      f: { type: 'Fallback', children: ['i'] },
      i: { type: 'Inverter', children: ['a'] },
      a: { type: 'Sleep' },
    },
  });
  fitView.mockClear();
  vi.spyOn(window, 'requestAnimationFrame').mockImplementation((draw) => {
    draw(0);
    return 0;
  });
  onTestFinished(showsTree('Main', { fitView } as unknown as Parameters<typeof showsTree>[1]));
});

describe('the commands of levels', () => {
  it('fold at a depth in one step of undo, and unfold all', () => {
    command('collapse1').run();
    expect(nodeOf('Main', 'f')?.collapsed).toBe(true);
    expect(nodeOf('Main', 'r')?.collapsed).toBeUndefined();
    command('collapseAll').run();
    expect(nodeOf('Main', 'f')?.collapsed).toBeUndefined();
    useProjectStore.getState().undo();
    expect(nodeOf('Main', 'f')?.collapsed).toBe(true);
    useProjectStore.getState().undo();
    expect(nodeOf('Main', 'i')?.collapsed).toBeUndefined();
  });

  it('show the whole tree as it is then', () => {
    command('collapse1').run();
    expect(fitView).toHaveBeenCalledTimes(1);
    command('collapseAll').run();
    expect(fitView).toHaveBeenCalledTimes(2);
  });

  it('are in the menu of the empty canvas if they have an effect', () => {
    expect(command('collapse2').inMenu(false)).toBe('collapse2');
    expect(command('collapse2').inMenu(true)).toBeNull();
    expect(command('collapseAll').inMenu(false)).toBeNull();
    expect(command('collapseAll').enabled?.()).toBe(false);
    command('collapse2').run();
    expect(command('collapseAll').inMenu(false)).toBe('collapseAll');
    expect(command('collapseAll').enabled?.()).toBe(true);
  });
});
