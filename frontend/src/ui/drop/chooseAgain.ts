import type { MouseEvent } from 'react';

/**
 * Properties of the field behind a `FileButton`, which keeps its file: without them the browser reports no change
 * when the same file is chosen again, after a dialogue that was declined or once the file was repaired.
 */
export const chooseAgain = {
  onClick: (event: MouseEvent<HTMLInputElement>) => {
    event.currentTarget.value = '';
  },
};
