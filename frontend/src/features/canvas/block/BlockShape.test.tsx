import { describe, expect, it } from 'vitest';
import { outline } from '@/ui/shapes';
import { show } from '../../../../harness/testing';
import { BlockShape } from './BlockShape';

type Props = Parameters<typeof BlockShape>[0];

function open(props: Partial<Props> = {}) {
  const { container } = show(<BlockShape family="action" width={140} height={66} {...props} />);
  const svg = container.querySelector('svg')!;
  return { svg, paths: [...svg.querySelectorAll(':scope > path')] };
}

describe('BlockShape', () => {
  it('has the size of its block and the outline of its family', () => {
    const { svg, paths } = open();
    expect(svg).toHaveAttribute('width', '140');
    expect(svg).toHaveAttribute('height', '66');
    expect(svg).toHaveAttribute('aria-hidden', 'true');
    expect(new Set(paths.map((path) => path.getAttribute('d')))).toEqual(
      new Set([outline('action', 140, 66)]),
    );
    expect(paths).toHaveLength(4);
  });

  it('colours the side within the outline', () => {
    const { svg } = open();
    const side = svg.querySelector('rect')!;
    expect(side).toHaveAttribute('width', '44');
    expect(side).toHaveAttribute('height', '66');
    expect(side).toHaveAttribute('clip-path', `url(#${svg.querySelector('clipPath')!.id})`);
    expect(svg.querySelector('clipPath path')).toHaveAttribute('d', outline('action', 140, 66));
  });

  it('draws a subtree as a stack', () => {
    const { paths } = open({ family: 'subtree' });
    expect(paths[0]).toHaveAttribute('transform', 'translate(4 4)');
    expect(open().svg.querySelector('[transform]')).toBeNull();
  });
});
