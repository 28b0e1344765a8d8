import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { restore } from './restoring';

const detail = (number: number, text: string) =>
  projectDetail(number, [projectFile('notes.md', number, text)]);
const text = () => useProjectStore.getState().currentText('notes.md');

beforeEach(() => {
  openProject({ texts: { 'notes.md': 'new' } });
  useProjectStore.getState().load(detail(4, 'new'));
  show(<p />);
});

describe('restore', () => {
  it('restores files, reports that, and offers to undo it', async () => {
    const { requests } = fakeServer({
      'POST /projects/p1/revisions/2/restore': detail(5, 'old'),
      'POST /projects/p1/revisions/4/restore': detail(6, 'new'),
    });
    await restore(2, ['notes.md']);
    expect(text()).toBe('old');
    expect(await screen.findByText('Revision 2 was restored as a new revision.')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Undo' }));
    await expect.poll(text).toBe('new');
    expect(requests.map(({ path, body }) => [path, body])).toEqual([
      ['/projects/p1/revisions/2/restore', { paths: ['notes.md'] }],
      ['/projects/p1/revisions/4/restore', { paths: ['notes.md'] }],
    ]);
  });

  it('reports that nothing had to change', async () => {
    fakeServer({ 'POST /projects/p1/revisions/2/restore': detail(4, 'new') });
    await restore(2, []);
    expect(await screen.findByText('The project already equals revision 2.')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Undo' })).toBeNull();
  });

  it('reports why a revision cannot be restored', async () => {
    fakeServer({ 'POST /projects/p1/revisions/2/restore': refusal('It was removed.') });
    await restore(2, []);
    expect(await screen.findByText('The revision could not be restored')).toBeInTheDocument();
    expect(screen.getByText('It was removed.')).toBeInTheDocument();
    expect(text()).toBe('new');
  });
});
