import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { openSession, show } from '../../../harness/testing';
import { useMoves } from './lastMove';
import { setMeasuring, useMeasuring } from './measuring';
import { pageHost } from './pageHost';
import type { BodyPose } from './scene/DraggedBody';

const AT: BodyPose = [1, 2, 0, 0, 0, 0];
const BEFORE: BodyPose = [0, 0, 0, 0, 0, 0];

beforeEach(() => {
  useMoves.setState({ last: null });
  setMeasuring(true);
});

describe('the page as host of its 3D view', () => {
  it('moves a body in the session, and keeps where it was', async () => {
    const executor = await openSession({ state: 'paused' });
    await pageHost.moveBody('crate', AT, BEFORE);
    expect(executor.sentAs('move_body')).toEqual([{ id: 'crate', pose: AT }]);
    expect(useMoves.getState().last).toEqual({ body: 'crate', from: BEFORE });
  });

  it('notifies the user if the session refuses', async () => {
    show(<div />);
    const executor = await openSession({ state: 'paused' });
    executor.refuse('move_body', 'The body is fixed.');
    await expect(pageHost.moveBody('crate', AT, BEFORE)).rejects.toThrow('The body is fixed.');
    expect(await screen.findByText('The body is fixed.')).toBeInTheDocument();
    expect(useMoves.getState().last).toBeNull();
  });

  it('adds measured points', () => {
    pageHost.addMeasured([1, 2, 3]);
    expect(useMeasuring.getState().points).toEqual([[1, 2, 3]]);
  });
});
