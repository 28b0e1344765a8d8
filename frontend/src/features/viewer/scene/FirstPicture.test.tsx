import { expect, it, vi } from 'vitest';
import { showScene } from '../../../../harness/scene';
import { FirstPicture } from './FirstPicture';

it('reports the first picture of a view, and no other', async () => {
  const onDrawn = vi.fn();
  const { draw } = showScene(<FirstPicture onDrawn={onDrawn} />);
  draw();
  await vi.waitFor(() => expect(onDrawn).toHaveBeenCalledOnce());
  draw();
  await Promise.resolve();
  expect(onDrawn).toHaveBeenCalledOnce();
});
