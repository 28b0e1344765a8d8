import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { setEditor } from '@/store/project/editor';
import type { ShownProblem } from '@/store/project/problems';
import { forgetEditor } from '../../../../harness/canvas';
import { show, user } from '../../../../harness/testing';
import { ProblemMark } from './ProblemMark';

const problem: ShownProblem = {
  source: 'server',
  severity: 'warning',
  node: 'a',
  code: '',
  message: 'It is odd.',
  hint: 'Look again.',
};

beforeEach(() => forgetEditor());

describe('ProblemMark', () => {
  it.each(['error', 'warning', 'note'] as const)('shows an %s and how to fix it', (severity) => {
    show(<ProblemMark problem={{ ...problem, severity }} onOpen={() => undefined} />);
    const mark = screen.getByRole('button', { name: 'It is odd. Look again.' });
    expect(mark).toHaveAttribute('data-severity', severity);
    expect(mark).toHaveAttribute('tabindex', '-1');
    expect(mark).toHaveAttribute('aria-haspopup', 'dialog');
  });

  it('opens the fixes at a press', async () => {
    const onOpen = vi.fn();
    show(<ProblemMark problem={problem} onOpen={onOpen} />);
    await user.click(screen.getByTestId('problem-mark'));
    expect(onOpen).toHaveBeenCalledOnce();
  });

  it('is no button if there is nothing to open', () => {
    show(<ProblemMark problem={problem} />);
    expect(screen.queryByRole('button')).toBeNull();
    expect(screen.getByRole('img', { name: 'It is odd. Look again.' })).toHaveAttribute(
      'data-severity',
      'warning',
    );
  });

  it('shows its text in a tooltip, unless the fixes are open', async () => {
    show(<ProblemMark problem={problem} onOpen={() => undefined} />);
    await user.hover(screen.getByTestId('problem-mark'));
    expect(await screen.findByText('It is odd.')).toBeInTheDocument();
    expect(screen.getByText('Look again.')).toBeInTheDocument();
    act(() => setEditor({ fixing: 'a' }));
    expect(screen.queryByText('It is odd.')).toBeNull();
  });

  it('leaves out an empty hint', async () => {
    show(<ProblemMark problem={{ ...problem, hint: '' }} onOpen={() => undefined} />);
    await user.hover(screen.getByTestId('problem-mark'));
    const tip = (await screen.findByText('It is odd.')).parentElement!;
    expect(tip.querySelectorAll('div:not([class*=arrow])')).toHaveLength(0);
  });
});
