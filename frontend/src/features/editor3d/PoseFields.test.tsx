import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import type { Pose } from '@/model/document/values';
import { write } from '../../../harness/documents';
import { openProject, show, user } from '../../../harness/testing';
import { PoseFields } from './PoseFields';

const POSE: Pose = [1, 2, 3, 0.1, 0.2, Math.PI / 4];

function fields(more: Partial<Parameters<typeof PoseFields>[0]> = {}) {
  openProject({});
  const onChange = vi.fn();
  show(<PoseFields pose={POSE} onChange={onChange} {...more} />);
  return onChange;
}

describe('PoseFields', () => {
  it('show metres, and degrees to a hundredth', () => {
    fields();
    const values = ['x', 'y', 'z', 'roll', 'pitch', 'yaw'].map(
      (axis) => screen.getByTestId<HTMLInputElement>(`field-${axis}`).value,
    );
    expect(values).toEqual(['1', '2', '3', '5.73', '11.46', '45']);
    expect(screen.getByText('Place (m)')).toBeInTheDocument();
    expect(screen.getByText('Turned by (°)')).toBeInTheDocument();
  });

  it.each([
    ['x', '7', [7, 2, 3, 0.1, 0.2, Math.PI / 4]],
    ['z', '-1', [1, 2, -1, 0.1, 0.2, Math.PI / 4]],
    ['pitch', '90', [1, 2, 3, 0.1, Math.PI / 2, Math.PI / 4]],
    ['yaw', '180', [1, 2, 3, 0.1, 0.2, Math.PI]],
  ])('change only %s', async (axis, text, pose) => {
    const onChange = fields();
    await write(`field-${axis}`, text);
    expect(onChange).toHaveBeenCalledExactlyOnceWith(pose.map((part) => expect.closeTo(part, 9) as number));
  });

  it('step by decimetres or a given step, and by 15 degrees', async () => {
    const onChange = fields({ step: 0.5, testId: 'wheel' });
    await user.type(screen.getByTestId('wheel-x'), '{ArrowUp}');
    expect(onChange.mock.lastCall?.[0]).toEqual([1.5, 2, 3, 0.1, 0.2, Math.PI / 4]);
    await user.type(screen.getByTestId('wheel-yaw'), '{ArrowDown}');
    expect((onChange.mock.lastCall?.[0] as Pose)[5]).toBeCloseTo(Math.PI / 6);
  });

  it('have only the heading for an upright thing', () => {
    fields({ isUpright: true });
    expect(screen.queryByTestId('field-roll')).toBeNull();
    expect(screen.queryByTestId('field-pitch')).toBeNull();
    expect(screen.getByTestId('field-yaw')).toHaveValue('45');
  });
});
