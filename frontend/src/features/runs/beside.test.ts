import { expect, it, vi } from 'vitest';
import { openBeside } from './beside';

it('takes the right half of the screen', () => {
  vi.stubGlobal('screen', { availWidth: 1920, availHeight: 1000 });
  const open = vi.spyOn(window, 'open').mockReturnValue(null);
  openBeside('/projects/p1?run=r1');
  expect(open).toHaveBeenCalledWith(
    '/projects/p1?run=r1',
    '_blank',
    'popup,noopener,left=960,top=0,width=960,height=1000',
  );
  vi.unstubAllGlobals();
  open.mockRestore();
});
