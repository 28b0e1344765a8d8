import { act, screen } from '@testing-library/react';
import i18next from 'i18next';
import { beforeEach, describe, expect, it } from 'vitest';
import { setEditor } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { now, openDiagram } from '../../../../harness/canvas';
import { nodeOf, show, user } from '../../../../harness/testing';
import { BlockTitle } from './BlockTitle';

function Title({ id }: { readonly id: string }) {
  const node = useProjectStore((state) => state.diagrams['Main']?.nodes[id]);
  if (!node) return null;
  return (
    <div data-testid="canvas" tabIndex={-1}>
      <BlockTitle id={id} node={node} t={i18next.getFixedT('en', 'canvas')} />
    </div>
  );
}

beforeEach(() => {
  openDiagram({
    root: 'r',
    nodes: {
      r: { type: 'Sequence', name: 'Work', children: ['a', 'c', 's', 't'] },
      a: { type: 'Sleep' },
      c: { type: 'Sleep', comment: 'slow' },
      s: { type: 'SubTree', tree: 'Dock' },
      t: { type: 'Sleep', conditions: { _while: 'x' } },
    },
  });
});

const edit = (node: string, field: 'name' | 'comment') => act(() => setEditor({ editing: { node, field } }));

describe('BlockTitle', () => {
  it.each([
    ['a', 'Sleep'],
    ['r', 'WorkSequence'],
    ['s', 'DockSubTree'],
    ['c', 'Sleep'],
  ])('shows %s as %s, with the type below if it differs from the name', (id, text) => {
    const { container } = show(<Title id={id} />);
    expect(container.querySelector('[class*=titles]')).toHaveTextContent(text);
    expect(container.querySelector('[class*=titles]')!.textContent).toBe(text);
  });

  it('has badges below a name that is the type', () => {
    show(<Title id="c" />);
    expect(screen.getByTitle('slow')).toBeInTheDocument();
    show(<Title id="t" />);
    expect(screen.getByTitle('_while: x')).toBeInTheDocument();
  });

  it('has no second line if it would be empty', () => {
    const { container } = show(<Title id="a" />);
    expect(container.querySelector('[class*=subtitle]')).toBeNull();
  });

  it('edits the name in one step', async () => {
    show(<Title id="r" />);
    edit('r', 'name');
    expect(screen.getByRole('textbox', { name: 'Name' })).toHaveValue('Work');
    await user.keyboard('Rest{Enter}');
    expect(nodeOf('Main', 'r')?.name).toBe('Rest');
    expect(now.editor().editing).toBeNull();
    expect(screen.queryByRole('textbox')).toBeNull();
    expect(screen.getByText('Rest')).toBeInTheDocument();
  });

  it('edits the comment, which may be empty', async () => {
    show(<Title id="a" />);
    edit('a', 'comment');
    expect(screen.getByRole('textbox', { name: 'Comment' })).toHaveValue('');
    await user.keyboard('a nap{Enter}');
    expect(nodeOf('Main', 'a')).toEqual({ type: 'Sleep', comment: 'a nap' });
    edit('a', 'comment');
    expect(screen.getByRole('textbox')).toHaveValue('a nap');
  });

  it('changes nothing after Escape', async () => {
    show(<Title id="r" />);
    edit('r', 'name');
    await user.keyboard('Rest{Escape}');
    expect(nodeOf('Main', 'r')?.name).toBe('Work');
    expect(now.editor().editing).toBeNull();
  });

  it('edits only one block', () => {
    show(<Title id="a" />);
    edit('r', 'name');
    expect(screen.queryByRole('textbox')).toBeNull();
  });
});
