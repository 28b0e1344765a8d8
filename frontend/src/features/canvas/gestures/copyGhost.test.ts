import { expect, it } from 'vitest';
import { CopyGhost } from './copyGhost';

it('is a picture of the blocks that no query finds instead of them', () => {
  const canvas = document.createElement('div');
  canvas.innerHTML =
    '<div class="react-flow__viewport"><i class="react-flow__node" data-id="a" style="left: 3px">' +
    '<b data-testid="node-a" data-type="Sleep" data-family="action">Sleep</b></i></div>';
  const ghost = new CopyGhost(canvas, 'a', [canvas.querySelector('i')!]);
  ghost.moveBy(1, 2);
  const shown = canvas.querySelector<HTMLElement>('.react-flow__viewport > [aria-hidden]')!;
  expect(shown.style.translate).toBe('1px 2px');
  expect(shown).toHaveTextContent('Sleep+');
  expect(shown.querySelector('[data-family=action]')).not.toBeNull();
  expect(shown.querySelector('[data-testid], [data-type], [data-id], .react-flow__node')).toBeNull();
  expect(shown.querySelector('i')).toHaveStyle({ left: '3px' });
  expect(canvas).toHaveAttribute('data-copying');
  ghost.remove();
  expect(canvas.querySelector('[aria-hidden]')).toBeNull();
  expect(canvas).not.toHaveAttribute('data-copying');
  expect(canvas.querySelector('[data-id=a] [data-type]')).not.toBeNull();
});
