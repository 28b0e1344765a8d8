import { act, fireEvent, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { HALL, lookOnly, openUniverse, showUniverse } from '../../../harness/documents';
import { fakeServer } from '../../../harness/testing';
import { UniverseView } from './UniverseView';

function view(text = HALL, prepare: () => void = () => undefined) {
  fakeServer({ 'GET /catalog/robots': [] });
  const editor = openUniverse(text);
  prepare();
  return { editor, ...showUniverse(editor, (now) => <UniverseView editor={editor} universe={now} />) };
}

const EMPTY = 'format: bt-studio/universe\nversion: 1\nname: Empty\nrobots: []\n';

describe('the view of a universe', () => {
  it('is one control, with a description if there is no WebGL', () => {
    view();
    const control = screen.getByRole('application', { name: /^Hall\. The world in 3D\./ });
    expect(control).toHaveAttribute('data-things', '5');
    expect(screen.getByRole('note')).toHaveTextContent(
      'This browser has no WebGL, so the world is not shown',
    );
    expect(screen.queryByText(/An empty floor/)).toBeNull();
    expect(screen.queryByText(/Click from corner to corner/)).toBeNull();
  });

  it('handles the keys of the editor', () => {
    const { editor, thing } = view();
    select(editor, ['crate']);
    const control = screen.getByTestId('universe-view');
    fireEvent.keyDown(control, { key: 'ArrowUp' });
    expect(thing('crate')).toMatchObject({ pose: [1.1, 2, 0.2, 0, 0, 0] });
    fireEvent.keyDown(control, { key: 'w' });
    expect(screen.getByText('Click from corner to corner. Esc ends the wall.')).toBeInTheDocument();
    fireEvent.keyDown(screen.getByTestId('place-wall'), { key: 'Delete' });
    expect(thing('crate')).toBeDefined();
  });

  it('explains how an empty floor is filled', () => {
    view(EMPTY);
    expect(
      screen.getByText('An empty floor. Place something from the left, or draw walls with W.'),
    ).toBeInTheDocument();
  });

  it('announces the selection and its position', () => {
    const { editor } = view();
    const status = screen.getByRole('status');
    expect(status).toBeEmptyDOMElement();
    act(() => select(editor, ['crate']));
    expect(status).toHaveTextContent('crate at x 1, y 2');
    act(() => select(editor, ['walker']));
    expect(status).toHaveTextContent('walker at x 0, y 0');
    act(() => select(editor, ['crate', 'ball']));
    expect(status).toHaveTextContent('2 things are selected.');
    act(() => select(editor, ['gone']));
    expect(status).toBeEmptyDOMElement();
  });

  it('has no palette in a read-only project', () => {
    view(HALL, lookOnly);
    expect(screen.queryByRole('toolbar', { name: 'Things to place' })).toBeNull();
  });
});
