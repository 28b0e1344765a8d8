import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { show } from '../../../harness/testing';
import { Since } from './Since';
import { changedSince } from './useSince';

const ran = { ...emptyDiagram('Main'), root: 'a', nodes: { a: { type: 'Go' }, b: { type: 'Stop' } } };

it('says that a tree is gone, renamed, or only roughly compared', () => {
  const recorded = { diagram: ran, isAttached: false };
  const { unmount } = show(<Since since={changedSince(recorded, ['Main'], {})} />);
  expect(screen.getByRole('status')).toHaveTextContent('does not have this tree any more');
  expect(screen.queryByRole('list')).toBeNull();
  unmount();
  show(<Since since={changedSince(recorded, ['Main'], { Hall: { ...ran, id: 'Hall' } })} />);
  expect(screen.getByRole('status')).toHaveTextContent(
    /now called “Hall”.*only blocks, names and ports are compared/,
  );
});
