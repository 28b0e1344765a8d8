import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { now, openDiagram } from '../../../harness/canvas';
import { nodeOf, show, user } from '../../../harness/testing';
import { FixBox } from './FixBox';

const onClose = vi.fn();

beforeEach(() => {
  onClose.mockReset();
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['a', 'g'] },
      a: { type: 'Sleep', name: 'Nap', ports: { msec: '{' } },
      g: { type: 'AlwaysSuccess' },
    },
  });
});

function open(id: string, block?: DOMRect) {
  const drawn = document.body.appendChild(document.createElement('div'));
  drawn.dataset['testid'] = `node-${id}`;
  drawn.getBoundingClientRect = () => block ?? new DOMRect(100, 50, 140, 44);
  show(<FixBox diagram={now.diagram()} id={id} onClose={onClose} />);
  drawn.remove();
}
const box = () => screen.getByTestId('fix-box');

describe('FixBox', () => {
  it('shows the problem of the block, and focuses the first fix', () => {
    open('a');
    expect(box()).toHaveAccessibleName('Fixes for “Nap”');
    expect(box()).toHaveTextContent('has a brace without its partner');
    expect(screen.getAllByRole('button')[0]).toHaveFocus();
  });

  it('takes the focus itself if there is no fix', () => {
    open('g');
    expect(screen.queryByRole('button')).toBeNull();
    expect(box()).toHaveFocus();
  });

  it('fixes the block and closes', async () => {
    open('a');
    await user.click(screen.getAllByRole('button')[0]!);
    expect(nodeOf('Main', 'a')?.ports).toEqual({ msec: '{msec}' });
    expect(onClose).toHaveBeenCalled();
  });

  it.each([
    [new DOMRect(100, 50, 140, 44), { left: '100px', top: '102px' }],
    [new DOMRect(-300, -300, 140, 44), { left: '8px', top: '8px' }],
    [new DOMRect(3000, 3000, 140, 44), { left: `${1024 - 328}px`, top: `${768 - 248}px` }],
  ])('is below the block and within the window', (block, place) => {
    open('a', block);
    expect(box()).toHaveStyle({ ...place, width: '320px', maxHeight: '240px' });
  });

  it('closes with Escape alone', () => {
    const onKey = vi.fn();
    document.addEventListener('keydown', onKey);
    open('a');
    fireEvent.keyDown(box(), { key: 'Delete' });
    expect(onClose).not.toHaveBeenCalled();
    fireEvent.keyDown(box(), { key: 'Escape' });
    expect(onClose).toHaveBeenCalledOnce();
    document.removeEventListener('keydown', onKey);
    expect(onKey).not.toHaveBeenCalled();
  });

  it('closes when the focus leaves it', () => {
    open('a');
    const [first] = screen.getAllByRole('button');
    fireEvent.blur(first!, { relatedTarget: box() });
    expect(onClose).not.toHaveBeenCalled();
    fireEvent.blur(first!, { relatedTarget: document.body });
    expect(onClose).toHaveBeenCalledOnce();
  });

  it('is absent if the block was deleted', () => {
    open('gone');
    expect(screen.queryByTestId('fix-box')).toBeNull();
  });
});
