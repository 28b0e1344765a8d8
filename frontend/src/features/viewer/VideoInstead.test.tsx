import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { VideoInstead } from './VideoInstead';

it('explains why it shows video, and returns to 3D', async () => {
  const onBack = vi.fn();
  show(<VideoInstead hz={2.4} onBack={onBack} />);
  expect(screen.getByRole('status')).toHaveTextContent('3D drew only 2 pictures a second here');
  expect(screen.getByTestId('viewer-video')).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Back to 3D' }));
  expect(onBack).toHaveBeenCalledOnce();
});
