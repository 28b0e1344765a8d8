import { act, screen, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { revision } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { useLabel, useRevisions } from './useRevisions';

const LIST = 'GET /projects/p1/revisions?limit=100';

function List({ path, isVisible }: { readonly path: string; readonly isVisible: boolean }) {
  const found = useRevisions(path, isVisible);
  const label = useLabel();
  return (
    <>
      <p>{found.items.map(({ number, label: name }) => `${number}${name}`).join(' ')}</p>
      <button onClick={() => void found.fetchNextPage()}>more</button>
      <button onClick={() => void label(3, 'works')}>label</button>
    </>
  );
}

function open(answers: Record<string, unknown>, path = '', isVisible = true, hasProject = true) {
  const { requests } = fakeServer(answers);
  if (hasProject) openProject({});
  show(<List path={path} isVisible={isVisible} />);
  return () => requests.map(({ method, path: address }) => `${method} ${address}`);
}

describe('useRevisions', () => {
  it('lists revisions page by page', async () => {
    const asked = open({
      [LIST]: { items: [revision(3)], next_before: 3 },
      [`${LIST}&before=3`]: { items: [revision(2), revision(1)], next_before: null },
    });
    expect(await screen.findByText('3')).toBeInTheDocument();
    await user.click(screen.getByText('more'));
    expect(await screen.findByText('3 2 1')).toBeInTheDocument();
    expect(asked()).toEqual([LIST, `${LIST}&before=3`]);
  });

  it('lists those of one file', async () => {
    const asked = open(
      { [`${LIST}&path=trees%2FMain.json`]: { items: [revision(3)], next_before: null } },
      'trees/Main.json',
    );
    expect(await screen.findByText('3')).toBeInTheDocument();
    expect(asked()).toEqual([`${LIST}&path=trees%2FMain.json`]);
  });

  it('lists again after a new revision', async () => {
    const answers: Record<string, unknown> = { [LIST]: { items: [revision(3)], next_before: null } };
    open(answers);
    expect(await screen.findByText('3')).toBeInTheDocument();
    answers[LIST] = { items: [revision(4), revision(3)], next_before: null };
    act(() => useProjectStore.setState({ revision: 4 }));
    expect(await screen.findByText('4 3')).toBeInTheDocument();
  });

  it.each([
    ['is hidden', false, true],
    ['has no project', true, false],
  ])('requests nothing while it %s', async (_, isVisible, hasProject) => {
    const asked = open({}, '', isVisible, hasProject);
    await act(() => Promise.resolve());
    expect(asked()).toEqual([]);
  });
});

describe('useLabel', () => {
  it('names a revision, and lists it by its name', async () => {
    const label = 'PATCH /projects/p1/revisions/3';
    const answers: Record<string, unknown> = {
      [LIST]: { items: [revision(3)], next_before: null },
      [label]: revision(3),
    };
    const asked = open(answers);
    await screen.findByText('3');
    answers[LIST] = { items: [revision(3, { label: 'works' })], next_before: null };
    await user.click(screen.getByText('label'));
    expect(await screen.findByText('3works')).toBeInTheDocument();
    expect(asked()).toEqual([LIST, label, LIST]);
  });

  it('names nothing without a project', async () => {
    const asked = open({}, '', true, false);
    await user.click(screen.getByText('label'));
    await waitFor(() => expect(asked()).toEqual([]));
  });
});
