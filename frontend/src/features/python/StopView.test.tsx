import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
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
