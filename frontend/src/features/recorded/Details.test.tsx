import { screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { atPresent, useMoment } from '@/store/moment/store';
import type { RecordedNode } from '@/store/recording/types';
import { show } from '../../../harness/testing';
import { Details } from './Details';

const diagram = {
  ...emptyDiagram('Main'),
  nodes: { a: { type: 'Go', name: 'ahead', ports: { speed: '{v}' } }, b: { type: 'Off' } },
};

it('says what the ports of a block were given, and which block did not run', () => {
  onTestFinished(() => useMoment.setState(atPresent));
  const ran = { tree_id: 'Main', node_id: 'a', ports: { speed: '0.5' } } as unknown as RecordedNode;
  useMoment.setState({ tree: [ran] });
  const { unmount } = show(<Details diagram={diagram} id="a" />);
  expect(screen.getByTestId('past-details')).toHaveTextContent('aheadGoidlespeed = 0.5');
  unmount();
  show(<Details diagram={diagram} id="b" />);
  expect(screen.getByTestId('past-details')).toHaveTextContent('OffNot part of the run');
});
