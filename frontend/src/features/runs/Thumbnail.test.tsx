import { expect, it } from 'vitest';
import type { StoredRun } from '@/api/runs';
import { show } from '../../../harness/testing';
import { Thumbnail } from './Thumbnail';

const run = { id: 'r1', has_thumbnail: true } as StoredRun;

it('shows the picture of a run', () => {
  const { container } = show(<Thumbnail projectId="p1" run={run} />);
  expect(container.querySelector('img')).toHaveAttribute(
    'src',
    expect.stringMatching('p1/runs/r1/thumbnail'),
  );
});

it('asks for no picture that is not there', () => {
  const { container } = show(<Thumbnail projectId="p1" run={{ ...run, has_thumbnail: false }} />);
  expect(container.querySelector('img')).toBeNull();
});
