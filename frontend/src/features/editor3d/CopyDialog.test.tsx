import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { CopyDialog } from './CopyDialog';

describe('CopyDialog', () => {
  it('has a title, and closes', async () => {
    const onClose = vi.fn();
    show(
      <CopyDialog title="New robot" isOpen onClose={onClose}>
        <p>the form</p>
      </CopyDialog>,
    );
    expect(screen.getByRole('dialog', { name: 'New robot' })).toHaveTextContent('the form');
    await user.click(screen.getByRole('button', { name: 'Cancel' }));
    expect(onClose).toHaveBeenCalledOnce();
  });

  it('has no content while it is closed', () => {
    show(
      <CopyDialog title="New robot" isOpen={false} onClose={() => undefined}>
        <p>the form</p>
      </CopyDialog>,
    );
    expect(screen.queryByText('the form')).toBeNull();
  });
});
