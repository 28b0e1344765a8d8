import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { useUndoTarget } from '@/commands/undo';
import { translates } from '@/i18n';
import { setName } from '@/model/edits';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../../harness/canvas';
import { nodeOf } from '../../../../harness/testing';
import { showsTree } from '../view/views';
import { FIT_KEYS, registerCanvasCommands } from './canvasCommands';

const store = () => useProjectStore.getState();
const command = (id: string) => useCommandTable.getState().commands[id]!;
const isEnabled = (id: string) => command(id).enabled?.() !== false;

let end: () => void;

beforeEach(() => {
  Element.prototype.checkVisibility = () => true;
  document.body.innerHTML = '<div data-testid="canvas" data-tree="Main" tabindex="0"></div>';
  openDiagram({ root: 'r', nodes: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } });
  end = registerCanvasCommands();
  onTestFinished(() => {
    end();
    document.body.innerHTML = '';
    useUndoTarget.setState({ target: null });
  });
});

it('has a label for each command, and unregisters all of them at the end', () => {
  const ids = Object.keys(useCommandTable.getState().commands);
  expect(ids).toEqual(expect.arrayContaining(['edit.undo', 'edit.copy', 'canvas.fit', 'canvas.minimap']));
  for (const id of ids) expect(translates(command(id).labelKey)).toBe(true);
  end();
  expect(useCommandTable.getState().commands).toEqual({});
});

describe('undo and redo', () => {
  it('go through the steps of the tree', () => {
    expect(isEnabled('edit.undo')).toBe(false);
    expect(isEnabled('edit.redo')).toBe(false);
    store().apply('Main', 'rename', [setName('a', 'Nap')]);
    expect(isEnabled('edit.undo')).toBe(true);
    perform('edit.undo');
    expect(nodeOf('Main', 'a')?.name).toBeUndefined();
    expect(isEnabled('edit.undo')).toBe(false);
    for (const id of ['edit.redo', 'edit.redoShift']) {
      expect(isEnabled(id)).toBe(true);
      perform(id);
      expect(nodeOf('Main', 'a')?.name).toBe('Nap');
      perform('edit.undo');
    }
  });

  it('go through those of another document while that is in front', () => {
    const travel = vi.fn();
    store().apply('Main', 'rename', [setName('a', 'Nap')]);
    useUndoTarget.setState({ target: { canUndo: false, canRedo: true, travel } });
    expect(isEnabled('edit.undo')).toBe(false);
    expect(isEnabled('edit.redo')).toBe(true);
    perform('edit.redo');
    useUndoTarget.setState({ target: { canUndo: true, canRedo: false, travel } });
    perform('edit.undo');
    expect(travel.mock.calls).toEqual([['redo'], ['undo']]);
    expect(nodeOf('Main', 'a')?.name).toBe('Nap');
    expect(isEnabled('edit.redoShift')).toBe(false);
  });
});

it('selects all blocks while the canvas has the focus', () => {
  expect(isEnabled('edit.selectAll')).toBe(false);
  document.querySelector<HTMLElement>('[data-testid="canvas"]')!.focus();
  perform('edit.selectAll');
  expect(now.selection()).toEqual(['r', 'a']);
});

it('opens the search', () => {
  perform('canvas.find');
  expect(now.editor().find).toBe(true);
});

describe('the layout', () => {
  it('changes to the other direction', () => {
    expect([isEnabled('canvas.vertical'), isEnabled('canvas.horizontal')]).toEqual([false, true]);
    perform('canvas.horizontal');
    expect(now.diagram().layout).toBe('horizontal');
    expect([isEnabled('canvas.vertical'), isEnabled('canvas.horizontal')]).toEqual([true, false]);
    perform('canvas.vertical');
    expect(now.diagram().layout).toBe('vertical');
  });

  it('is tidied', () => {
    store().apply('Main', 'place', [(draft) => void (draft.nodes['a']!.position = [900, 900])]);
    perform('canvas.tidy');
    expect(nodeOf('Main', 'a')?.position).toBeUndefined();
  });

  it.each(['canvas.tidy', 'canvas.vertical', 'canvas.horizontal', 'canvas.minimap'])(
    'does nothing with %s while no tree is open',
    (id) => {
      store().setActiveTree(null);
      expect(isEnabled(id)).toBe(false);
    },
  );
});

it('shows and hides the overview', () => {
  perform('canvas.minimap');
  expect(now.editor().minimap).toBe(true);
  perform('canvas.minimap');
  expect(now.editor().minimap).toBe(false);
});

describe('the view', () => {
  const VIEWS = ['canvas.fit', 'canvas.zoomIn', 'canvas.zoomOut', 'canvas.zoomReset'];

  it('has commands while the tree is drawn', () => {
    expect(VIEWS.filter(isEnabled)).toEqual([]);
    const view = { zoomIn: vi.fn(), zoomOut: vi.fn(), zoomTo: vi.fn(), fitView: vi.fn() };
    onTestFinished(showsTree('Main', view as unknown as Parameters<typeof showsTree>[1]));
    VIEWS.forEach((id) => perform(id));
    expect(view.fitView).toHaveBeenCalledOnce();
    expect(view.zoomIn).toHaveBeenCalledOnce();
    expect(view.zoomOut).toHaveBeenCalledOnce();
    expect(view.zoomTo).toHaveBeenCalledOnce();
    expect(isEnabled('canvas.fitSelection')).toBe(false);
    store().select('Main', ['a']);
    perform('canvas.fitSelection');
    expect(view.fitView.mock.lastCall?.[0]).toMatchObject({ nodes: [{ id: 'a' }] });
  });

  it('is fitted with the keys of other editors', () => {
    expect(command('canvas.fit').shortcut).toBe(FIT_KEYS.all);
    expect(command('canvas.fitSelection').shortcut).toBe('Shift+Digit2');
    expect(FIT_KEYS.all).toBe('Shift+Digit1');
  });
});
