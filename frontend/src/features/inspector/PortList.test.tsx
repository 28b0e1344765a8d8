import { act, fireEvent, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { shownTarget } from '../../../harness/target';
import { action, nodeOf, openProject, openSession, port, show, user } from '../../../harness/testing';
import { PortList } from './PortList';

const List = shownTarget('Main', PortList);
const portsOf = (id: string) => nodeOf('Main', id)?.ports;
const fields = () => screen.queryAllByTestId(/^port-/).map(({ dataset }) => dataset['testid']?.slice(5));
const adding = () => screen.queryByRole('button', { name: 'Add port' });
const nameField = () => screen.getByLabelText('Name of the port');

beforeEach(() => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 'b', 'o', 'p', 's', 'x'] },
        a: { type: 'Drive', ports: { speed: '1', extra: 'e' } },
        b: { type: 'AlwaysSuccess' },
        o: { type: 'Open', ports: { one: '1' } },
        p: { type: 'Open', ports: { two: '{key}' } },
        s: { type: 'SubTree', tree: 'Dock', ports: { far: '{goal}' } },
        x: { type: 'Nowhere', ports: { lost: '{alpha}' } },
      },
    },
    actions: [
      action('Drive', { ports: [port('speed', 'double'), port('count', 'int', { required: true })] }),
      action('Open', { open: true }),
    ],
    texts: { 'trees/Dock.json': oneBlock('Dock', 'AlwaysSuccess') },
    selected: ['a'],
  });
});

describe('the ports of a block', () => {
  it('are the declared ones, and those set beyond them', () => {
    show(<List id="a" />);
    expect(fields()).toEqual(['speed', 'count', 'extra']);
    expect(adding()).toBeNull();
    expect(screen.queryByText('This node has no ports.')).toBeNull();
  });

  it('can be absent', () => {
    show(<List id="b" />);
    expect(screen.getByText('This node has no ports.')).toBeInTheDocument();
  });

  it('are written in one step of undo', async () => {
    show(<List id="a" />);
    await user.clear(screen.getByTestId('port-speed'));
    await user.type(screen.getByTestId('port-speed'), '2.5');
    expect(portsOf('a')).toEqual({ speed: '2.5', extra: 'e' });
    act(() => useProjectStore.getState().undo());
    expect(portsOf('a')).toEqual({ speed: '1', extra: 'e' });
  });

  it('show an error if their value is wrong', async () => {
    show(<List id="a" />);
    expect(screen.getByTestId('port-count')).toBeInvalid();
    expect(screen.getByTestId('port-speed')).toBeValid();
    await user.type(screen.getByTestId('port-count'), '3');
    expect(screen.getByTestId('port-count')).toBeValid();
    await user.type(screen.getByTestId('port-speed'), 'x');
    expect(screen.getByTestId('port-speed')).toBeInvalid();
  });

  it('offer the keys of the tree in order', async () => {
    show(<List id="s" />);
    await user.click(screen.getByTestId('port-far'));
    fireEvent.change(screen.getByTestId('port-far'), { target: { value: '{' } });
    expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual(['{alpha}', '{key}']);
  });

  it('that are not declared are removed from this block alone', async () => {
    show(<List id="a" />);
    expect(screen.queryByRole('button', { name: 'Remove port speed' })).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Remove port extra' }));
    expect(portsOf('a')).toEqual({ speed: '1' });
  });
});

describe('a port that differs from that of the running program', () => {
  const open = async () => {
    const executor = await openSession();
    const value = { node_id: 'a', tree_id: 'Main', path: 'Drive', effect: 'next_tick' } as const;
    executor.emit('port_set', { ...value, port: 'speed', value: '1', saved: '0.3' });
    show(<List id="a" />);
    return within(screen.getByTestId('live-speed'));
  };

  it('goes back to the value before in one step of undo, and has the caret', async () => {
    const live = await open();
    await user.click(live.getByRole('button', { name: 'Back to the value before' }));
    expect(portsOf('a')).toEqual({ speed: '0.3', extra: 'e' });
    expect(screen.queryByTestId('live-speed')).toBeNull();
    expect(screen.getByTestId('port-speed')).toHaveFocus();
    act(() => useProjectStore.getState().undo());
    expect(portsOf('a')).toEqual({ speed: '1', extra: 'e' });
    expect(screen.getByTestId('live-speed')).toBeInTheDocument();
  });

  it('keeps its value', async () => {
    const live = await open();
    await user.click(live.getByRole('button', { name: 'Keep this value' }));
    expect(portsOf('a')).toEqual({ speed: '1', extra: 'e' });
    expect(screen.queryByTestId('live-speed')).toBeNull();
    expect(screen.getByTestId('port-speed')).toHaveFocus();
  });
});

describe('a subtree', () => {
  it('gets another port, as a key of its name, alone', async () => {
    show(<List id="s" />);
    await user.click(adding()!);
    expect(nameField()).toHaveFocus();
    await user.type(nameField(), 'near{Enter}');
    expect(portsOf('s')).toEqual({ far: '{goal}', near: '{near}' });
    expect(screen.queryByLabelText('Name of the port')).toBeNull();
    expect(screen.queryByRole('button', { name: /^Rename (?!this key)/ })).toBeNull();
  });

  it('gets none with a taken name, and none after Escape', async () => {
    show(<List id="s" />);
    await user.click(adding()!);
    await user.type(nameField(), 'far');
    expect(screen.getByText('There is a port of that name already.')).toBeInTheDocument();
    await user.keyboard('{Escape}');
    expect(screen.queryByLabelText('Name of the port')).toBeNull();
    expect(portsOf('s')).toEqual({ far: '{goal}' });
  });
});

describe('blocks of an action that declares no ports', () => {
  it('have the ports of all of them', async () => {
    show(<List id="o" />);
    expect(fields()).toEqual(['one', 'two']);
    await user.click(adding()!);
    await user.type(nameField(), 'three{Enter}');
    expect(portsOf('o')).toEqual({ one: '1', three: '{three}' });
    expect(portsOf('p')).toEqual({ two: '{key}', three: '{three}' });
  });

  it('are renamed and removed together', async () => {
    show(<List id="o" />);
    await user.click(screen.getByRole('button', { name: 'Rename port two' }));
    await user.clear(nameField());
    await user.type(nameField(), 'deux{Enter}');
    expect(portsOf('p')).toEqual({ deux: '{key}' });
    await user.click(screen.getByRole('button', { name: 'Remove port deux' }));
    expect(portsOf('p')).toBeUndefined();
  });
});

it('accepts ports of an unknown type', async () => {
  show(<List id="x" />);
  expect(fields()).toEqual(['lost']);
  expect(adding()).not.toBeNull();
  expect(within(screen.getByText('lost').parentElement!).getAllByRole('button')).toHaveLength(5);
});
