import { act, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { connectedClient } from '../../../../harness/languageServer';
import { show, user } from '../../../../harness/testing';
import type { PlacesInFile } from '../language/places';
import { closeReferences, useReferences } from '../language/references';
import { ReferencesPanel } from './ReferencesPanel';

const group = (name: string, lines: readonly number[], isOutside = false): PlacesInFile => ({
  uri: `file:///project/${name}`,
  name,
  isOutside,
  places: lines.map((line) => ({ uri: `file:///project/${name}`, line, from: 0, to: 2, text: `Go ${line}` })),
});
const chosen = () => screen.getByRole('option', { selected: true }).textContent;
const onLeave = vi.fn();
let shown: string[];

async function open(groups: readonly PlacesInFile[]) {
  const { client } = await connectedClient({});
  client.workspace.displayFile = async (uri) => {
    shown.push(uri);
    return null;
  };
  act(() => useReferences.setState({ found: { name: 'Go', client, groups, request: 1 } }));
}

beforeEach(() => {
  shown = [];
  onLeave.mockClear();
  onTestFinished(closeReferences);
  show(<ReferencesPanel onLeave={onLeave} />);
});

describe('ReferencesPanel', () => {
  it('lists the places by file, with their number', async () => {
    expect(screen.queryByTestId('references')).toBeNull();
    await open([group('a.py', [0, 4]), group('rclpy/node.py', [9], true)]);
    expect(screen.getByRole('status')).toHaveTextContent('3 places in 2 files');
    expect(within(screen.getByRole('group', { name: 'a.py' })).getAllByRole('option')).toHaveLength(2);
    expect(screen.getByRole('group', { name: 'rclpy/node.py' })).toHaveTextContent('outside of the project');
    expect(screen.getByRole('listbox', { name: 'References to Go' })).toHaveFocus();
  });

  it('is walked and left by keys', async () => {
    await open([group('a.py', [0, 4]), group('b.py', [9])]);
    expect(chosen()).toBe('1Go 0');
    await user.keyboard('{ArrowDown}{ArrowDown}{ArrowDown}');
    expect(chosen()).toBe('10Go 9');
    await user.keyboard('{Enter}');
    expect(shown).toEqual(['file:///project/b.py']);
    await user.keyboard('{Home}{ArrowUp}');
    expect(chosen()).toBe('1Go 0');
    await user.keyboard('{End}{PageUp}{PageDown}');
    expect(chosen()).toBe('10Go 9');
    await user.keyboard('x{Escape}');
    expect(screen.queryByTestId('references')).toBeNull();
    expect(onLeave).toHaveBeenCalledOnce();
  });

  it('opens what is clicked, and stays', async () => {
    await open([group('a.py', [0, 4])]);
    await user.click(screen.getAllByRole('option')[1] as HTMLElement);
    expect(shown).toEqual(['file:///project/a.py']);
    expect(chosen()).toBe('5Go 4');
    await user.click(screen.getByRole('button', { name: 'Close the references' }));
    expect(screen.queryByTestId('references')).toBeNull();
  });

  it('says that there is none', async () => {
    await open([]);
    expect(screen.getByRole('status')).toHaveTextContent('Nothing refers to it.');
    await user.keyboard('{ArrowDown}{Enter}');
    expect(shown).toEqual([]);
  });
});
