import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { childrenOf } from '@/model/diagram';
import { vocabulary } from '@/model/testing';
import { setEditor } from '@/store/project/editor';
import { now, openDiagram } from '../../../harness/canvas';
import { nodeOf, show, user } from '../../../harness/testing';
import { PaletteItem } from './PaletteItem';

const specOf = (type: string) => vocabulary.specs.get(type)!;
const dock = { kind: { type: 'SubTree', tree: 'Dock' }, spec: specOf('SubTree'), label: 'Dock' };

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: { r: { type: 'Sequence', children: ['f'] }, f: { type: 'Fallback' } },
  });
});

describe('PaletteItem', () => {
  it('adds its block below the selected one', async () => {
    show(<PaletteItem choice={{ kind: { type: 'Sleep' }, spec: specOf('Sleep'), label: 'Sleep' }} />);
    await user.click(screen.getByTestId('palette-Sleep'));
    const [, added] = childrenOf(now.diagram(), 'r');
    expect(nodeOf('Main', added!)).toEqual({ type: 'Sleep' });
    expect(now.selection()).toEqual([added]);
  });

  it('has the name of the tree that it calls', async () => {
    show(<PaletteItem choice={dock} />);
    expect(screen.getByTestId('palette-Dock')).toHaveAccessibleName('Add Dock');
    await user.click(screen.getByTestId('palette-Dock'));
    expect(nodeOf('Main', now.selection()[0]!)).toEqual(dock.kind);
  });

  it('is dragged with its name, until it is dropped anywhere', () => {
    show(<PaletteItem choice={dock} />);
    const item = screen.getByTestId('palette-Dock');
    expect(item).toHaveAttribute('draggable', 'true');
    const given: string[] = [];
    const dataTransfer = { effectAllowed: '', setData: (...data: string[]) => given.push(...data) };
    fireEvent.dragStart(item, { dataTransfer });
    expect(dataTransfer.effectAllowed).toBe('copy');
    expect(given).toEqual(['text/plain', 'Dock']);
    expect(now.editor().dragged).toEqual(dock.kind);
    const mark = { x: 0, y: 0, width: 1, height: 1 };
    setEditor({ slot: { parent: 'r', index: 0, kind: 'onto', mark } });
    fireEvent.dragEnd(item);
    expect(now.editor()).toMatchObject({ dragged: null, slot: null });
  });

  it('shows no tooltip while it is dragged, and again afterwards', async () => {
    show(<PaletteItem choice={dock} />);
    const item = screen.getByTestId('palette-Dock');
    await user.hover(item);
    await screen.findByRole('tooltip');
    fireEvent.pointerDown(item);
    expect(screen.queryByRole('tooltip')).toBeNull();
    fireEvent.dragEnd(item);
    await user.unhover(item);
    await user.hover(item);
    expect(await screen.findByRole('tooltip')).toBeInTheDocument();
  });

  it('shows its description in a tooltip', async () => {
    show(<PaletteItem choice={dock} />);
    await user.hover(screen.getByTestId('palette-Dock'));
    expect(await screen.findByText(dock.spec.summary)).toBeInTheDocument();
  });
});
