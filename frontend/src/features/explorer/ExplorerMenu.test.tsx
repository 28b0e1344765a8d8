import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { isOffered } from '@/model/treeAttributes';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../harness/testing';
import { ExplorerItem } from './ExplorerItem';
import { ExplorerMenu } from './ExplorerMenu';

const choose = async (name: string) => user.click(await screen.findByRole('menuitem', { name }));
const paths = () => Object.keys(useProjectStore.getState().files);

beforeEach(() => {
  openProject({ trees: { Main: { r: { type: 'Sequence' } } }, texts: { 'notes/a.md': 'Hello' } });
});

describe('a right click, or the menu key', () => {
  beforeEach(() => {
    show(<ExplorerItem path="notes/a.md" isTree={false} isAction={false} worst={undefined} />);
    fireEvent.contextMenu(screen.getByTestId('file-notes/a.md'));
  });

  it('duplicates, and takes it back', async () => {
    await choose('Duplicate');
    expect(paths()).toContain('notes/a_copy.md');
    await user.click(await screen.findByRole('button', { name: 'Undo' }));
    expect(paths()).not.toContain('notes/a_copy.md');
  });

  it('copies the path', async () => {
    const writeText = vi.fn(async () => undefined);
    vi.stubGlobal('navigator', { ...navigator, clipboard: { writeText } });
    await choose('Copy path');
    expect(writeText).toHaveBeenCalledExactlyOnceWith('notes/a.md');
    expect(await screen.findByText('The path is in the clipboard: notes/a.md')).toBeInTheDocument();
    writeText.mockRejectedValueOnce(new Error('denied'));
    fireEvent.contextMenu(screen.getByTestId('file-notes/a.md'));
    await choose('Copy path');
    expect(await screen.findByText(/The path is notes\/a\.md$/)).toBeInTheDocument();
    vi.unstubAllGlobals();
  });
});

it('opens at the pointer, or at its button', () => {
  const props = { path: 'b.md', name: 'b.md', isOpened: true, onChange: vi.fn(), onOpen: vi.fn() };
  const { rerender, container } = show(<ExplorerMenu {...props} point={{ x: 12, y: 34 }} />);
  const target = () => container.querySelector<HTMLElement>('[aria-expanded]');
  expect(target()?.style).toMatchObject({ left: '12px', top: '34px' });
  expect(screen.getByRole('menu', { name: 'More for b.md' })).toBeInTheDocument();
  rerender(<ExplorerMenu {...props} point={null} />);
  expect(target()).toHaveAccessibleName('More for b.md');
});

it('is shut until it is asked for', () => {
  show(
    <ExplorerMenu
      path="b.md"
      name="b.md"
      isOpened={false}
      point={null}
      onChange={vi.fn()}
      onOpen={vi.fn()}
    />,
  );
  expect(screen.getByRole('button', { name: 'More for b.md' })).toHaveAttribute('aria-expanded', 'false');
});

describe('a tree', () => {
  beforeEach(() => {
    show(<ExplorerItem path="trees/Main.json" isTree isAction={false} worst={undefined} />);
    fireEvent.contextMenu(screen.getByTestId('file-trees/Main.json'));
  });

  it('is offered in the library, and no longer', async () => {
    const offered = () => isOffered(useProjectStore.getState().diagrams['Main']!);
    await choose('Offer in the library');
    expect(offered()).toBe(true);
    expect(await screen.findByText(/Your other projects find Main/)).toBeInTheDocument();
    fireEvent.contextMenu(screen.getByTestId('file-trees/Main.json'));
    await choose('No longer offer in the library');
    expect(offered()).toBe(false);
    useProjectStore.getState().undo('Main');
    expect(offered()).toBe(true);
  });

  it('is copied as a block that calls it', async () => {
    const writeText = vi.fn(async () => undefined);
    vi.stubGlobal('navigator', { ...navigator, clipboard: { writeText } });
    await choose('Copy');
    expect(writeText).toHaveBeenCalledExactlyOnceWith(expect.stringContaining('<SubTree ID="Main"/>'));
    vi.unstubAllGlobals();
  });
});
