import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { searchHere } from '../../../harness/searchWorker';
import { SearchPanel } from './SearchPanel';
import { setSearch } from './searchStore';

let navigator: ReturnType<typeof watchNavigation>;

beforeEach(() => {
  searchHere();
  openProject({
    trees: {
      Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Go', ports: { speed: '{speed}' } } },
    },
    texts: { 'actions/Go.py': 'import math\nspeed = 1\n' },
  });
  navigator = watchNavigation();
  show(<SearchPanel />);
});

const field = () => screen.getByTestId('search-text');
const group = (path: string) => screen.findByTestId(`search-in-${path}`);
const rows = () => [...document.querySelectorAll<HTMLElement>('[data-row]')];

async function search(text: string): Promise<void> {
  await user.type(field(), text);
  await waitFor(() => expect(rows().length).toBeGreaterThan(0));
}

describe('SearchPanel', () => {
  it('explains what is searched before anything is typed', () => {
    expect(screen.getByRole('status')).toHaveTextContent('every line of all files');
  });

  it('shows the hits by tree and file, marked', async () => {
    await search('speed');
    expect(screen.getByRole('status')).toHaveTextContent('3 hits in 2 documents.');
    const tree = within(await group('trees/Main.json'));
    expect(
      tree
        .getAllByRole('button')
        .slice(1)
        .map(({ textContent }) => textContent),
    ).toEqual(['speedGo · port speed', '{speed}Go · speed']);
    const file = within(await group('actions/Go.py'));
    expect(file.getByText('speed').tagName).toBe('MARK');
    expect(file.getByText('Line 2')).toBeInTheDocument();
  });

  it('opens the block or the line, also by keys', async () => {
    await search('speed');
    field().focus();
    await user.keyboard('{ArrowDown}{ArrowDown}{Enter}');
    expect(navigator.openTree).toHaveBeenCalledWith('Main');
    expect(useProjectStore.getState().revealed).toMatchObject({ tree: 'Main', node: 'a' });
    await user.keyboard('{ArrowDown}{Enter}');
    expect(navigator.openFile).toHaveBeenCalledWith('actions/Go.py', 2);
    await user.keyboard('{ArrowUp}');
    expect(rows()[1]).toHaveFocus();
  });

  it('uses its options for the text', async () => {
    await search('SPEED');
    await user.click(screen.getByRole('button', { name: 'Match upper and lower case' }));
    await waitFor(() => expect(screen.getByRole('status')).toHaveTextContent('Nothing was found.'));
    act(() => setSearch({ text: 'sp(', isRegex: true, matchesCase: false }));
    expect(await screen.findByText(/not a regular expression: Unterminated group/)).toBeInTheDocument();
    expect(field()).toBeInvalid();
  });

  it('previews and makes a replacement, which is undone in one step', async () => {
    await search('speed');
    await user.click(screen.getByRole('button', { name: 'Replace' }));
    await user.type(screen.getByTestId('search-replacement'), 'v');
    await waitFor(() => expect(document.querySelectorAll('ins')).toHaveLength(2));
    expect([...document.querySelectorAll('ins')].map(({ textContent }) => textContent)).toEqual(['v', 'v']);
    expect(screen.getAllByRole('img', { name: /refers to something else/ })).toHaveLength(1);
    await user.click(screen.getByTestId('replace-all'));
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '{v}' });
    expect(useProjectStore.getState().currentText('actions/Go.py')).toBe('import math\nv = 1\n');
    expect(await screen.findByText('2 hits were replaced in 2 documents.')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '{speed}' });
  });

  it('replaces one hit, or those of one document', async () => {
    await search('speed');
    act(() => setSearch({ isReplacing: true, replacement: 'v' }));
    await waitFor(() => expect(document.querySelectorAll('ins')).toHaveLength(2));
    await user.click(screen.getAllByRole('button', { name: 'Replace this one' })[0]!);
    expect(nodeOf('Main', 'a')?.ports).toEqual({ speed: '{v}' });
    expect(useProjectStore.getState().currentText('actions/Go.py')).toContain('speed');
    const rest = screen.getByRole('button', { name: 'Replace all in actions/Go.py' });
    await waitFor(() => expect(rest).toBeEnabled());
    await user.click(rest);
    expect(useProjectStore.getState().currentText('actions/Go.py')).not.toContain('speed');
  });

  it('replaces nothing in a read-only project, and reports that', async () => {
    await search('speed');
    act(() => useProjectStore.setState({ role: 'viewer' }));
    act(() => setSearch({ isReplacing: true }));
    expect(screen.getByTestId('search-replacement')).toBeDisabled();
    expect(screen.getByText(/read-only/)).toBeInTheDocument();
    expect(screen.getByTestId('replace-all')).toBeDisabled();
    expect(screen.queryByRole('button', { name: 'Replace this one' })).toBeNull();
  });
});
