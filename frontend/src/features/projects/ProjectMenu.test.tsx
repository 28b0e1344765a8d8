import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import type { ProjectShelf } from '@/api/client';
import { noContent, refusal, summary } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { ProjectMenu } from './ProjectMenu';
import { useProjectCommands } from './useProjects';

const onRename = vi.fn();

function Menu({ shelf }: { readonly shelf: ProjectShelf }) {
  return (
    <ProjectMenu project={summary('p1')} shelf={shelf} actions={useProjectCommands()} onRename={onRename} />
  );
}

async function open(answers: Readonly<Record<string, unknown>> = {}, shelf: ProjectShelf = 'current') {
  const { requests } = fakeServer(answers);
  show(<Menu shelf={shelf} />);
  await user.click(screen.getByRole('button', { name: 'More for Project p1' }));
  return () => requests.map(({ method, path }) => `${method} ${path}`);
}

const choose = (name: string) => user.click(screen.getByRole('menuitem', { name }));

describe('ProjectMenu', () => {
  it('offers the commands for a project', async () => {
    await open();
    expect(screen.getAllByRole('menuitem').map(({ textContent }) => textContent)).toEqual([
      'Rename',
      'Duplicate',
      'Download as zip',
      'Archive',
      'Delete',
    ]);
    const download = screen.getByRole('menuitem', { name: 'Download as zip' });
    expect(download).toHaveAttribute('href', '/api/v1/projects/p1/export');
    expect(download).toHaveAttribute('download');
  });

  it('starts renaming', async () => {
    const asked = await open();
    await choose('Rename');
    expect(onRename).toHaveBeenCalledOnce();
    expect(asked()).toEqual([]);
  });

  it('duplicates', async () => {
    const asked = await open({ 'POST /projects/p1/duplicate': summary('p2') });
    await choose('Duplicate');
    await expect.poll(asked).toEqual(['POST /projects/p1/duplicate']);
  });

  it.each([
    [
      'Archive',
      'POST /projects/p1/archive',
      '“Project p1” is in the archive.',
      'POST /projects/p1/unarchive',
    ],
    ['Delete', 'DELETE /projects/p1', '“Project p1” was deleted.', 'POST /projects/p1/restore'],
  ])('%s can be undone', async (item, request, words, undo) => {
    const asked = await open({ [request]: noContent(), [undo]: noContent() });
    await choose(item);
    expect(await screen.findByText(words)).toBeInTheDocument();
    expect(asked()).toEqual([request]);
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    await expect.poll(asked).toEqual([request, undo]);
  });

  it('takes a project out of the archive', async () => {
    const asked = await open({ 'POST /projects/p1/unarchive': noContent() }, 'archived');
    expect(screen.queryByRole('menuitem', { name: 'Archive' })).toBeNull();
    await choose('Take out of the archive');
    await expect.poll(asked).toEqual(['POST /projects/p1/unarchive']);
    expect(screen.queryByRole('button', { name: 'Undo' })).toBeNull();
  });

  it.each([
    ['Duplicate', 'POST /projects/p1/duplicate'],
    ['Archive', 'POST /projects/p1/archive'],
    ['Delete', 'DELETE /projects/p1'],
  ])('reports why %s was refused', async (item, request) => {
    await open({ [request]: refusal('It runs.', { hint: 'Stop it.' }) });
    await choose(item);
    expect(await screen.findByText('That did not work')).toBeInTheDocument();
    expect(screen.getByText('It runs. Stop it.')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Undo' })).toBeNull();
  });
});
