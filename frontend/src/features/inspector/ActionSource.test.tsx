import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../harness/testing';
import { ActionSource } from './ActionSource';

const source = () => screen.findByRole('textbox', { name: 'Source of actions/Drive.py' });

beforeEach(() => {
  openProject({
    trees: { Main: {} },
    texts: { 'actions/Drive.py': 'class Drive: ...', 'actions/Park.py': 'class Park: ...' },
  });
});

describe('ActionSource', () => {
  it('is absent for an action without a file', () => {
    const { container } = show(<ActionSource action="Gone" />);
    expect(container).not.toHaveTextContent('Source');
    expect(screen.queryByRole('button')).toBeNull();
  });

  it('shows the source on demand, scrolls to it, and stays open for the next action', async () => {
    const scroll = vi.spyOn(Element.prototype, 'scrollIntoView');
    const { unmount } = show(<ActionSource action="Drive" />);
    expect(screen.queryByTestId('action-source')).toBeNull();
    expect(screen.getByRole('button', { name: 'Show' })).toHaveAttribute('aria-expanded', 'false');
    await user.click(screen.getByRole('button', { name: 'Show' }));
    expect(await source()).toHaveTextContent('class Drive: ...');
    await waitFor(() => expect(scroll).toHaveBeenCalledWith({ block: 'nearest' }));
    unmount();
    show(<ActionSource action="Park" />);
    expect(screen.getByRole('button', { name: 'Hide' })).toHaveAttribute('aria-expanded', 'true');
    expect(await screen.findByRole('textbox', { name: 'Source of actions/Park.py' })).toHaveTextContent(
      'class Park: ...',
    );
    await user.click(screen.getByRole('button', { name: 'Hide' }));
    expect(screen.queryByTestId('action-source')).toBeNull();
  });

  it('follows the text', async () => {
    show(<ActionSource action="Drive" />);
    await user.click(screen.getByRole('button', { name: 'Show' }));
    await source();
    act(() => useProjectStore.getState().setFileText('actions/Drive.py', 'class Drive: pass'));
    expect(await source()).toHaveTextContent('class Drive: pass');
    await user.click(screen.getByRole('button', { name: 'Hide' }));
  });
});
