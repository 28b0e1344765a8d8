import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { wheelWidth } from '@/model/robot/edits';
import { openRobot, showRobot, URDF, write } from '../../../harness/documents';
import { user } from '../../../harness/testing';
import { DriveFields, WheelFields } from './DriveFields';

function fields() {
  const editor = openRobot();
  return showRobot(editor, (now) => <DriveFields editor={editor} robot={now} />);
}

describe('the fields of the whole robot', () => {
  it('name and describe it', async () => {
    const robot = fields();
    await write('robot-name', 'Rover');
    await write(screen.getByRole('textbox', { name: 'Description' }), 'Fast.');
    expect(robot()).toMatchObject({ name: 'Rover', description: 'Fast.' });
    expect(screen.getByText(/Select a part to change it/)).toBeInTheDocument();
  });

  it('change the drive, except for values that the wheels determine', async () => {
    const robot = fields();
    await write('value-wheel_torque', '3');
    expect(robot().drive['wheel_torque']).toBe(3);
    expect(screen.queryByTestId('value-wheel_radius')).toBeNull();
    expect(screen.queryByTestId('value-track')).toBeNull();
    expect(screen.getByText('Drive')).toBeInTheDocument();
  });

  it('choose the type of its commands', async () => {
    const robot = fields();
    const select = screen.getByTestId('command-type');
    expect([...(select as HTMLSelectElement).options].map(({ text }) => text)).toEqual([
      'Twist and TwistStamped',
      'Twist',
      'TwistStamped',
    ]);
    await user.selectOptions(select, 'TwistStamped');
    expect(robot().commandType).toBe('twist_stamped');
  });

  it('leave the ground truth out of the file if it is not set', async () => {
    const robot = fields();
    const truth = screen.getByRole('checkbox', { name: /Publishes its true pose/ });
    await user.click(truth);
    expect(robot().raw['ground_truth']).toBe(true);
    await user.click(truth);
    expect('ground_truth' in robot().raw).toBe(false);
  });
});

describe('the fields of the wheels', () => {
  function wheels(texts: Record<string, string> = {}) {
    const editor = openRobot(texts);
    return showRobot(editor, (now) => <WheelFields editor={editor} robot={now} />);
  }

  it.each([
    ['wheel-radius', '0.001', 0.005],
    ['wheel-radius', '3', 2],
    ['wheel-width', '0.001', 0.002],
    ['wheel-width', '3', 1],
    ['wheel-track', '0.001', 0.01],
    ['wheel-track', '7', 5],
  ])('keep %s of %s in its range', async (field, text, kept) => {
    const robot = wheels();
    await write(field, text);
    const now = robot();
    const value = {
      'wheel-radius': now.wheelRadius,
      'wheel-width': wheelWidth(now),
      'wheel-track': now.track,
    };
    expect(value[field as keyof typeof value]).toBeCloseTo(kept, 6);
  });

  it.each([
    ['wheel-radius', '0.055'],
    ['wheel-width', '0.037'],
    ['wheel-track', '0.27'],
  ])('step %s finely', async (field, value) => {
    wheels();
    await user.type(screen.getByTestId(field), '{ArrowUp}');
    expect(screen.getByTestId(field)).toHaveValue(value);
  });

  it('have no width for wheels that are no cylinders', () => {
    wheels({ [URDF]: robotUrdf.replace(/<cylinder[^>]*>/g, '<sphere radius="0.05"/>') });
    expect(screen.queryByTestId('wheel-width')).toBeNull();
    expect(screen.getByTestId('wheel-radius')).toBeInTheDocument();
  });
});
