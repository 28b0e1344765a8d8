import { fireEvent, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { DiagramNode } from '@/model/diagram';
import { openProject, show, user } from '../../../harness/testing';
import { diagramOf } from './useSides';
import { TreePicture } from './TreePicture';

const treeOf = (nodes: Readonly<Record<string, DiagramNode>>) => {
  const tree = diagramOf(
    JSON.stringify({ format: 'bt-studio/diagram', version: 1, id: 'Main', root: 'r', nodes, drafts: [] }),
    'Main',
  );
  if (!tree) throw new Error('The tree cannot be read.');
  return tree;
};

const before = treeOf({
  r: { type: 'Sequence', children: ['gone', 'a', 'b', 'c'] },
  gone: { type: 'AlwaysFailure' },
  a: { type: 'Delay', name: 'wait', ports: { delay_msec: '100', old: '1' }, children: ['d'] },
  d: { type: 'AlwaysSuccess' },
  b: { type: 'AlwaysSuccess', name: 'bee' },
  c: { type: 'AlwaysSuccess', name: 'sea' },
});
const after = treeOf({
  r: { type: 'Sequence', children: ['c', 'a', 'b', 'new'] },
  a: { type: 'Delay', name: 'wait', ports: { delay_msec: '200', fresh: '2' }, children: ['d'] },
  d: { type: 'AlwaysSuccess' },
  b: { type: 'AlwaysSuccess', name: 'bee' },
  c: { type: 'AlwaysSuccess', name: 'sea' },
  new: { type: 'AlwaysSuccess', name: 'fresh one' },
});

const list = () => screen.getByRole('list', { name: 'List of differences' });
const rows = () =>
  within(list())
    .queryAllByRole('listitem')
    .map(({ textContent }) => textContent);
const picture = () => screen.getByTestId('picture-difference');
const mark = (id: string) => picture().querySelector(`[data-node="${id}"]`) as SVGGElement;
const ring = (id: string) => mark(id).querySelector('rect') as SVGRectElement;

beforeEach(() => openProject({}));

describe('TreePicture', () => {
  it('lists what was added, removed, changed and moved', () => {
    show(<TreePicture before={before} after={after} />);
    expect(screen.getByText(/blocks differ/)).toHaveTextContent('4 blocks differ');
    expect(rows()).toEqual([
      '−AlwaysFailure removed',
      '⇄sea reordered',
      '≠wait changeddelay_msec 100 → 200old 1fresh 2',
      '+fresh one added',
    ]);
  });

  it('marks the same blocks in the picture', () => {
    show(<TreePicture before={before} after={after} />);
    const kinds = ['gone', 'c', 'a', 'new'].map((id) => [
      mark(id).getAttribute('data-change'),
      mark(id).querySelector('text')?.textContent,
      ring(id).getAttribute('stroke-dasharray'),
    ]);
    expect(kinds).toEqual([
      ['removed', '−', '7 5'],
      ['moved', '⇄', null],
      ['changed', '≠', null],
      ['added', '+', null],
    ]);
    expect(mark('d')).toBeNull();
    expect(Number(ring('a').getAttribute('width'))).toBeGreaterThan(132);
  });

  it('highlights the block of the row under the pointer', () => {
    show(<TreePicture before={before} after={after} />);
    const row = within(list()).getByText('fresh one').closest('li') as HTMLElement;
    expect(ring('new').getAttribute('stroke-width')).toBe('3');
    fireEvent.pointerEnter(row);
    expect(ring('new').getAttribute('stroke-width')).toBe('6');
    expect(ring('gone').getAttribute('stroke-width')).toBe('3');
    fireEvent.pointerLeave(row);
    expect(ring('new').getAttribute('stroke-width')).toBe('3');
  });

  it('is shown in full size, or fitted', async () => {
    show(<TreePicture before={before} after={after} />);
    const larger = screen.getByRole('button', { name: 'In full size' });
    expect([larger.getAttribute('aria-pressed'), picture().dataset['large']]).toEqual(['false', undefined]);
    await user.click(larger);
    expect(picture().dataset['large']).toBe('true');
    await user.click(screen.getByRole('button', { name: 'As a whole' }));
    expect(picture().dataset['large']).toBeUndefined();
  });

  it('shows that no block differs', () => {
    show(<TreePicture before={before} after={before} />);
    expect(screen.getByText('No block differs; positions may.')).toBeInTheDocument();
    expect(rows()).toEqual([]);
    expect(picture().querySelector('[data-change]')).toBeNull();
  });
});
