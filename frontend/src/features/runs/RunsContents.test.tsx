import { act, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Segment } from '@/generated/messages';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { refusal } from '../../../harness/requests';
import { storedRun as run } from '../../../harness/runs';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { RunsContents } from './RunsContents';

const LIST = 'GET /projects/p1/runs';

function open(answers: Record<string, unknown>) {
  const { requests } = fakeServer(answers);
  openProject({});
  show(<RunsContents />);
  return () => requests.map(({ method, path, body }) => [method, path, body] as const);
}

const row = () => screen.findByTestId('run-r1');
const choose = async (name: string) => {
  await user.click(within(await row()).getByRole('button', { name: 'Commands on “Into the crate”' }));
  await user.click(await screen.findByRole('menuitem', { name }));
};

beforeEach(() => {
  onTestFinished(() => useSessionStore.setState(initialSession, true));
});

describe('the list', () => {
  it('says how a run can be kept if there is none', async () => {
    open({ [LIST]: { items: [] } });
    expect(await screen.findByText(/No run has been kept yet/)).toBeInTheDocument();
    expect(screen.queryByRole('form')).toBeNull();
  });

  it('shows what is known of a run, and its download', async () => {
    open({ [LIST]: { items: [run({ note: 'It turned too late.', is_pinned: true, is_shared: true })] } });
    expect(await row()).toHaveTextContent('Into the crate');
    expect(await row()).toHaveTextContent(/2:05 min · 2\.5 MB · .* · tina/);
    for (const text of ['Failure', 'Shared', 'It turned too late.']) {
      expect(await row()).toHaveTextContent(text);
    }
    expect(screen.getByRole('img', { name: 'Pinned' })).toBeInTheDocument();
    expect(screen.getByRole('link', { name: /Download the recording/ })).toHaveAttribute(
      'href',
      '/api/v1/projects/p1/runs/r1/recording',
    );
  });

  it('has no commands for runs of others', async () => {
    open({ [LIST]: { items: [run({ may_manage: false })] } });
    expect(within(await row()).queryByRole('button', { name: /Commands/ })).toBeNull();
  });

  it('shows why it cannot be read', async () => {
    open({ [LIST]: refusal('There is no such project.') });
    expect(await screen.findByText(/There is no such project/)).toBeInTheDocument();
  });
});

describe('the present run', () => {
  const segment = { run: 'a1' } as Segment;

  it('is kept with name and note', async () => {
    const asked = open({ [LIST]: { items: [] }, 'POST /projects/p1/runs': run() });
    act(() => useSessionStore.setState({ segments: [segment] }));
    const name = await screen.findByRole('textbox', { name: 'Name' });
    await user.clear(name);
    expect(screen.getByRole('button', { name: 'Keep' })).toBeDisabled();
    await user.type(name, 'Second try');
    await user.type(screen.getByRole('textbox', { name: 'Note' }), 'faster{Enter}');
    await screen.findByText(/No run has been kept yet/);
    expect(asked()).toContainEqual([
      'POST',
      '/projects/p1/runs',
      { run: 'a1', name: 'Second try', note: 'faster' },
    ]);
  });

  it('that cannot be kept is reported, and what was typed stays', async () => {
    open({ [LIST]: { items: [] }, 'POST /projects/p1/runs': refusal('No room.') });
    act(() => useSessionStore.setState({ segments: [segment] }));
    await user.type(await screen.findByRole('textbox', { name: 'Note' }), 'faster{Enter}');
    expect(await screen.findByText('The run was not kept')).toBeInTheDocument();
    expect(screen.getByRole('textbox', { name: 'Note' })).toHaveValue('faster');
  });
});

describe('a kept run', () => {
  const PATCH = 'PATCH /projects/p1/runs/r1';

  it('gets another name', async () => {
    const asked = open({ [LIST]: { items: [run()] }, [PATCH]: run() });
    await choose('Rename');
    const field = await screen.findByRole('textbox', { name: 'Name' });
    await user.clear(field);
    await user.type(field, 'Better{Enter}');
    expect(asked()).toContainEqual(['PATCH', '/projects/p1/runs/r1', { name: 'Better' }]);
  });

  it('is pinned', async () => {
    const asked = open({ [LIST]: { items: [run()] }, [PATCH]: run() });
    await choose('Pin (it stays when newer runs are kept)');
    expect(asked()).toContainEqual(['PATCH', '/projects/p1/runs/r1', { is_pinned: true }]);
  });

  it('is shared only after it was said what others then see', async () => {
    const asked = open({ [LIST]: { items: [run()] }, [PATCH]: run() });
    await choose('Share with the project…');
    const sure = await screen.findByRole('alert');
    expect(sure).toHaveTextContent("A recording contains the project's code");
    await user.click(within(sure).getByRole('button', { name: 'Share' }));
    expect(asked()).toContainEqual(['PATCH', '/projects/p1/runs/r1', { is_shared: true }]);
  });

  it('is deleted only after a question', async () => {
    const asked = open({
      [LIST]: { items: [run()] },
      'DELETE /projects/p1/runs/r1': new Response(null, { status: 204 }),
    });
    await choose('Delete');
    await user.click(within(await screen.findByRole('alert')).getByRole('button', { name: 'Cancel' }));
    expect(screen.queryByRole('alert')).toBeNull();
    await choose('Delete');
    await user.click(within(await screen.findByRole('alert')).getByRole('button', { name: 'Delete' }));
    expect(asked().map(([method]) => method)).toContain('DELETE');
  });
});
