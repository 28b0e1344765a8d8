import { act, screen, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { Me, ProjectRole } from '@/api/types';
import { perform, useCommandTable } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { account } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { ShareButton } from './ShareButton';

const command = () => useCommandTable.getState().commands['project.share'];

async function open(me: Me, role: ProjectRole = 'owner', hasProject = true) {
  const { requests } = fakeServer({
    'GET /me': me,
    'GET /groups': { items: [] },
    'GET /projects/p1/shares': { owner: { username: 'ada', name: '' }, people: [], groups: [], links: [] },
  });
  if (hasProject) openProject({});
  useProjectStore.setState({ role });
  const view = show(<ShareButton />);
  await waitFor(() => expect(requests).not.toEqual([]));
  await act(() => Promise.resolve());
  return view;
}

describe('ShareButton', () => {
  it('opens the sharing of the project', async () => {
    await open(account());
    await user.click(await screen.findByTestId('share'));
    expect(screen.getByRole('dialog', { name: 'Share “Test”' })).toBeInTheDocument();
    await user.keyboard('{Escape}');
    expect(screen.queryByRole('dialog')).toBeNull();
  });

  it('is also a command while it is shown', async () => {
    const { unmount } = await open(account());
    await screen.findByTestId('share');
    expect(command()).toMatchObject({ group: 'project', labelKey: 'accounts:share.button' });
    act(() => perform('project.share'));
    expect(screen.getByRole('dialog')).toBeInTheDocument();
    unmount();
    expect(command()).toBeUndefined();
  });

  it.each([
    ['on localhost', account({ mode: 'local' }), 'owner', true],
    ['for an editor', account(), 'editor', true],
    ['without a project', account(), 'owner', false],
  ] as const)('is absent %s', async (_, me, role, hasProject) => {
    await open(me, role, hasProject);
    expect(screen.queryByTestId('share')).toBeNull();
    expect(command()).toBeUndefined();
  });
});
