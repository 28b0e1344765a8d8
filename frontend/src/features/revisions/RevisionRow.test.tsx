import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { ComponentProps } from 'react';
import { useProjectStore } from '@/store/project';
import { revision } from '../../../harness/requests';
import { openProject, show, user } from '../../../harness/testing';
import { RevisionRow } from './RevisionRow';

const onChoose = vi.fn();
const onUnfold = vi.fn();

const row = (more: Partial<ComponentProps<typeof RevisionRow>> = {}) =>
  show(
    <RevisionRow
      revision={revision(3)}
      count={1}
      isChosen={false}
      isAlone
      onChoose={onChoose}
      onUnfold={onUnfold}
      {...more}
    />,
  );
const choice = () => screen.getByTestId('revision-3');
const time = () => screen.getByText(/ago|AM|PM/);

beforeEach(() => {
  onChoose.mockClear();
  onUnfold.mockClear();
  openProject({});
});

describe('RevisionRow', () => {
  it('shows the change and its age, and can be chosen', async () => {
    row();
    expect(choice()).toHaveTextContent(/^Edited MainTree#3.* ago$/);
    expect(time()).toHaveAttribute('datetime', '2026-01-01T10:03:00.000Z');
    expect(time().title).toBe(new Date('2026-01-01T10:03:00.000Z').toLocaleString('en'));
    expect(choice()).toHaveAttribute('aria-current', 'false');
    await user.click(choice());
    expect(onChoose).toHaveBeenCalledOnce();
    expect(onUnfold).not.toHaveBeenCalled();
  });

  it('shows its name first', () => {
    row({ revision: revision(3, { label: 'Works' }), isChosen: true });
    expect(choice()).toHaveTextContent(/^WorksEdited MainTree/);
    expect(choice()).toHaveAttribute('aria-current', 'true');
  });

  it('shows the author if there are several', () => {
    row({ isAlone: false });
    expect(choice()).toHaveTextContent(/ada$/);
  });

  it('shows the time of a save within a group', () => {
    row({ isInner: true });
    expect(time()).toHaveTextContent(new Date('2026-01-01T10:03:00.000Z').toLocaleTimeString('en'));
  });

  it('unfolds a group of saves', async () => {
    row({ count: 2 });
    const saves = screen.getByRole('button', { name: '2 saves' });
    expect(saves).toHaveAttribute('aria-expanded', 'false');
    await user.click(saves);
    expect(onUnfold).toHaveBeenCalledOnce();
    expect(onChoose).not.toHaveBeenCalled();
  });

  it('is shown as unfolded', () => {
    row({ count: 2, isUnfolded: true });
    expect(screen.getByRole('button', { name: '2 saves' })).toHaveAttribute('aria-expanded', 'true');
  });

  it('has no fold button for one save', () => {
    row();
    expect(screen.queryByTestId('saves-3')).toBeNull();
  });

  it('can be named by editors', () => {
    const { unmount } = row();
    expect(screen.getByRole('button', { name: 'Name revision 3' })).toBeEnabled();
    unmount();
    useProjectStore.setState({ role: 'viewer' });
    row();
    expect(screen.queryByRole('button', { name: 'Name revision 3' })).toBeNull();
  });
});
