import { act, screen, waitFor } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { useProjectStore } from '@/store/project';
import { useSessionStore } from '@/store/session/store';
import { useLines } from '@/store/python/lines';
import { usePython } from '@/store/python/stop';
import { stopInPython } from '../../../harness/pythonStop';
import { show, user, watchNavigation } from '../../../harness/testing';
import { StopView } from './StopView';

const SCOPES = { scopes: [{ name: 'Locals', variablesReference: 3 }] };
const LOCALS = { variables: [{ name: 'n', value: '3', type: 'int', variablesReference: 0 }] };

it('shows the stack and the variables of a frame', async () => {
  const { openFile } = watchNavigation();
  const python = await stopInPython();
  show(<StopView />);
  await python.answer('scopes', SCOPES);
  await python.answer('variables', LOCALS);
  expect(await screen.findByTestId('value-n')).toHaveTextContent('3');
  expect(screen.getByRole('button', { name: 'update actions/Turn.py:12' })).toHaveAttribute(
    'aria-current',
    'true',
  );
  await user.click(screen.getByRole('button', { name: 'tick outside of the project' }));
  expect(usePython.getState().stop?.frame).toBe(1);
  expect(openFile).not.toHaveBeenCalled();
  expect(await python.answer('scopes', { scopes: [] })).toEqual({ frameId: 8 });
});

it('begins the stack with the blocks that led there', async () => {
  const python = await stopInPython();
  const reveal = vi.fn();
  useProjectStore.setState({ reveal });
  const node = (uid: number, name: string) => ({
    uid,
    parent: uid - 1,
    type: 'Sequence',
    kind: '',
    name,
    path: name,
    node_id: `n${uid}`,
    tree_id: 'Main',
  });
  show(<StopView />);
  await python.answer('scopes', { scopes: [] });
  expect(screen.queryByTestId('python-tree-path')).toBeNull();
  act(() =>
    useSessionStore.setState({
      tree: [node(1, 'root'), node(2, 'Wiggle')],
      heldInPython: { uid: 2 } as never,
    }),
  );
  const [first] = screen.getAllByRole('listitem');
  expect(first).toHaveTextContent('root › Wiggle');
  await user.click(screen.getByTestId('python-tree-path'));
  expect(reveal).toHaveBeenCalledWith('Main', 'n2');
});

it('evaluates an expression, offers completions, and watches it', async () => {
  const python = await stopInPython();
  show(<StopView />);
  await python.answer('scopes', { scopes: [] });
  await user.type(screen.getByTestId('python-expression'), 'n');
  await python.answer('completions', { targets: [{ label: 'number' }] });
  await waitFor(() => expect(document.querySelector('option')).toHaveValue('number'));
  await user.click(screen.getByTestId('python-evaluate'));
  expect(await python.answer('evaluate', { result: '3', variablesReference: 0 })).toMatchObject({
    expression: 'n',
    context: 'repl',
  });
  await waitFor(() => expect(screen.getByTestId('python-answer')).toHaveTextContent('n3'));
  await python.answer('scopes', { scopes: [] });
  await user.click(screen.getByRole('button', { name: 'Watch this expression' }));
  expect(useLines.getState().watches).toEqual(['n']);
  await python.answer('evaluate', {}, 'Traceback\nNameError: n');
  expect(await screen.findByText('NameError: n')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Do not watch n any more' }));
  expect(useLines.getState().watches).toEqual([]);
});

it('says what an expression raised, and what was refused', async () => {
  const python = await stopInPython();
  show(<StopView />);
  await python.answer('scopes', { scopes: [] });
  usePython.setState({ refusal: 'not now' });
  expect(await screen.findByTestId('python-refusal')).toHaveTextContent('not now');
  await user.type(screen.getByTestId('python-expression'), 'y');
  await python.answer('completions', { targets: [] });
  await user.click(screen.getByTestId('python-evaluate'));
  await python.answer('evaluate', {}, 'Traceback\nNameError: y');
  await waitFor(() => expect(screen.getByTestId('python-answer')).toHaveTextContent('NameError: y'));
});
