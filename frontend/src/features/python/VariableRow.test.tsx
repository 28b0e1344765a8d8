import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { stopInPython } from '../../../harness/pythonStop';
import { show, user } from '../../../harness/testing';
import { VariableRow } from './VariableRow';

const self = { name: 'self', value: '<Turn>', type: 'Turn', reference: 3 };

it('asks for its parts when it is opened, and sets one of them', async () => {
  const python = await stopInPython();
  show(<VariableRow variable={self} />);
  expect(python.asked).toEqual([]);
  await user.click(screen.getByRole('button', { name: 'Parts of self' }));
  const n = { name: 'n', value: '3', type: 'int', variablesReference: 0 };
  expect(await python.answer('variables', { variables: [n] })).toEqual({ variablesReference: 3 });
  expect(await screen.findByTestId('value-n')).toHaveTextContent('3');
  await user.click(screen.getByRole('button', { name: 'Set n' }));
  await user.clear(screen.getByRole('textbox', { name: 'New value of n' }));
  await user.type(screen.getByRole('textbox'), '41{Enter}');
  expect(await python.answer('setVariable', { value: '41' })).toEqual({
    variablesReference: 3,
    name: 'n',
    value: '41',
  });
  expect(screen.queryByRole('textbox')).toBeNull();
});

it('leaves a value as it is on Escape, and says why parts cannot be read', async () => {
  const python = await stopInPython();
  show(<VariableRow variable={self} owner={2} />);
  await user.click(screen.getByRole('button', { name: 'Set self' }));
  await user.type(screen.getByRole('textbox'), 'x{Escape}');
  expect(python.asked).toEqual([]);
  await user.click(screen.getByRole('button', { name: 'Parts of self' }));
  await python.answer('variables', {}, 'It is gone.');
  expect(await screen.findByText('It is gone.')).toBeInTheDocument();
});
