import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { openProject, show, user } from '../../../harness/testing';
import { ResultGroup } from './ResultGroup';
import type { Row } from './results';

const row = (start: number): Row => ({
  passage: { path: 'actions/Go.py', place: null, text: 'go go' },
  hit: { text: 0, start, end: start + 2, replacement: 'run' },
});
const group = { path: 'actions/Go.py', rows: [row(0), row(3)] };
const onReplace = vi.fn();
const rows = () => document.querySelectorAll('[data-row]');

beforeEach(() => {
  openProject({});
  onReplace.mockClear();
});

describe('ResultGroup', () => {
  it('counts its hits, and folds', async () => {
    show(<ResultGroup group={group} isReplacing={false} isFresh onReplace={onReplace} />);
    const title = screen.getByRole('button', { name: /^actions.Go.py ?2$/ });
    expect(rows()).toHaveLength(2);
    await user.click(title);
    expect(rows()).toHaveLength(0);
    expect(title).toHaveAttribute('aria-expanded', 'false');
  });

  it('replaces all of its hits, or one', async () => {
    show(<ResultGroup group={group} isReplacing isFresh onReplace={onReplace} />);
    await user.click(screen.getByRole('button', { name: 'Replace all in actions/Go.py' }));
    expect(onReplace).toHaveBeenLastCalledWith(group.rows);
    await user.click(screen.getAllByRole('button', { name: 'Replace this one' })[1]!);
    expect(onReplace).toHaveBeenLastCalledWith([group.rows[1]]);
  });

  it('replaces nothing while the results are outdated', () => {
    show(<ResultGroup group={group} isReplacing isFresh={false} onReplace={onReplace} />);
    expect(screen.getByRole('button', { name: /^Replace all in/ })).toBeDisabled();
  });
});
