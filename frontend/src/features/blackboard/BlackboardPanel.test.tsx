import { screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { BlackboardEntry } from '@/generated/messages';
import { openSession, show, user, type FakeExecutor } from '../../../harness/testing';
import { BlackboardPanel } from './BlackboardPanel';

const entry = (key: string, type: string, value: unknown, more: Partial<BlackboardEntry> = {}) => ({
  scope: '',
  key,
  type,
  value,
  preview: false,
  removed: false,
  ...more,
});

let executor: FakeExecutor;

beforeEach(async () => {
  executor = await openSession({ state: 'paused' });
  show(<BlackboardPanel />);
});

const write = (...entries: BlackboardEntry[]) => {
  executor.emit('blackboard', { entries });
};
const field = (key: string) => screen.getByLabelText<HTMLInputElement>(`Value of ${key}`);

async function type(key: string, text: string) {
  await user.clear(field(key));
  await user.type(field(key), `${text}{Enter}`);
}

describe('BlackboardPanel', () => {
  it('explains before the first run what it will show', () => {
    expect(screen.getByText(/appear here when you run/)).toBeInTheDocument();
  });

  it('lists entries by scope and key, and drops removed ones', () => {
    write(
      entry('b', 'int', 2),
      entry('a', 'float', 0.123456789),
      entry('x', 'str', 'door', { scope: 'Dock' }),
    );
    const tables = screen.getAllByRole('table').map((table) => ({
      scope: table.querySelector('caption')?.textContent,
      keys: within(table)
        .getAllByRole('rowheader')
        .map(({ textContent }) => textContent),
    }));
    expect(tables).toEqual([
      { scope: 'Root', keys: ['a', 'b'] },
      { scope: 'Dock', keys: ['x'] },
    ]);
    expect(field('a')).toHaveValue('0.123457');
    write(entry('b', 'int', null, { removed: true }));
    expect(screen.queryByTestId('blackboard-b')).toBeNull();
  });

  it('writes a value with Enter', async () => {
    write(entry('limit', 'int', 2, { scope: 'Dock' }));
    await type('limit', '5');
    expect(executor.sentAs('set_blackboard')).toEqual([{ scope: 'Dock', key: 'limit', value: 5 }]);
  });

  it('writes a value when the field is left, unless it is unchanged', async () => {
    write(entry('goal', 'str', 'door'));
    await user.click(field('goal'));
    await user.tab();
    expect(executor.sentAs('set_blackboard')).toEqual([]);
    await user.type(field('goal'), 's');
    await user.tab();
    expect(executor.sentAs('set_blackboard')).toEqual([{ scope: '', key: 'goal', value: 'doors' }]);
  });

  it.each([
    ['int', 1, '1.5', 'x is a whole number, such as 5.'],
    ['float', 1, 'fast', 'x is a number, such as 0.5.'],
    ['list', [], '{{}}', 'x is a list, such as [1, 2].'],
    ['dict', {}, '[[]', 'x is a dict, such as {"x": 1}.'],
  ])('refuses an invalid %s, and says what is expected', async (kind, before, text, message) => {
    write(entry('x', kind, before));
    await type('x', text);
    expect(screen.getByText(message)).toBeInTheDocument();
    expect(field('x')).toBeInvalid();
    expect(executor.sentAs('set_blackboard')).toEqual([]);
    await user.type(field('x'), '{Escape}');
    expect(screen.queryByText(message)).toBeNull();
    expect(field('x')).toBeValid();
  });

  it('keeps a refused value in the field, with the reason', async () => {
    write(entry('limit', 'int', 2));
    executor.refuse('set_blackboard', 'The key is read-only.');
    await type('limit', '7');
    expect(await screen.findByText('The key is read-only.')).toBeInTheDocument();
    expect(field('limit')).toHaveValue('7');
  });

  it('chooses a boolean from a list', async () => {
    write(entry('isOn', 'bool', false));
    await user.selectOptions(field('isOn'), 'true');
    expect(executor.sentAs('set_blackboard')).toEqual([{ scope: '', key: 'isOn', value: true }]);
    await waitFor(() => {
      expect(field('isOn')).toHaveValue('false');
    });
  });

  it('shows the keys of py_trees, which nobody writes here', () => {
    write(entry('speed', 'double', 0.5, { scope: 'py_trees:/robot/' }));
    expect(screen.getByRole('table', { name: 'py_trees:/robot/' })).toBeInTheDocument();
    expect(screen.getByTestId('blackboard-speed')).toHaveTextContent('speed0.5number');
    expect(screen.queryByRole('textbox')).toBeNull();
  });

  it('writes nothing while the run continues, for shortened values, or as a viewer', () => {
    write(entry('long', 'list', '[1, 2, …', { preview: true }), entry('n', 'int', 1));
    expect(screen.queryByLabelText('Value of long')).toBeNull();
    expect(screen.getByTestId('blackboard-long')).toHaveTextContent('[1, 2, …');
    expect(field('n')).toBeInTheDocument();
    executor.introduce({ role: 'viewer', state: 'paused' });
    expect(screen.queryByRole('textbox')).toBeNull();
    executor.introduce({ role: 'driver', state: 'application_running' });
    expect(screen.queryByRole('textbox')).toBeNull();
    expect(screen.getByTestId('blackboard-n')).toHaveTextContent('n1whole number');
  });
});
