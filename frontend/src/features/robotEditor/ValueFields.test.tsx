import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import type { JsonObject } from '@/model/document/values';
import type { FieldsOf } from '@/model/robot/rules';
import { write } from '../../../harness/documents';
import { openProject, show, user } from '../../../harness/testing';
import { ValueFields } from './ValueFields';

function fields(kind: FieldsOf, values: JsonObject = {}, without: readonly string[] = []) {
  openProject({});
  const onChange = vi.fn();
  show(<ValueFields kind={kind} values={values} without={without} onChange={onChange} />);
  return onChange;
}

describe('ValueFields', () => {
  it('show the values, and the defaults of missing ones', () => {
    fields('lidar', { rays: 90, topic: '/front', noise_m: 'much' });
    expect(screen.getByTestId('value-rays')).toHaveValue('90');
    expect(screen.getByTestId('value-topic')).toHaveValue('/front');
    expect(screen.getByTestId('value-range_max')).toHaveValue('8');
    expect(screen.getByTestId('value-noise_m')).toHaveValue('0');
    expect(screen.getByText('Measures')).toBeInTheDocument();
  });

  it('leave out fields that are shown elsewhere', () => {
    fields('drive', {}, ['track']);
    expect(screen.queryByTestId('value-track')).toBeNull();
    expect(screen.getByTestId('value-wheel_radius')).toBeInTheDocument();
    expect(screen.getByText('Drive')).toBeInTheDocument();
  });

  it('accept only whole numbers for counts', async () => {
    const onChange = fields('lidar', { rays: 90 });
    await write('value-rays', '120.6');
    expect(onChange).toHaveBeenLastCalledWith('rays', 121);
    await user.type(screen.getByTestId('value-rays'), '{ArrowUp}');
    expect(onChange).toHaveBeenLastCalledWith('rays', expect.any(Number));
  });

  it('step counts by ten, angles by five degrees, and others by a tenth', async () => {
    const onChange = fields('lidar', { rays: 90, range_max: 4, fov: Math.PI });
    await user.type(screen.getByTestId('value-rays'), '{ArrowUp}');
    expect(onChange).toHaveBeenLastCalledWith('rays', 100);
    await user.type(screen.getByTestId('value-range_max'), '{ArrowUp}');
    expect(onChange).toHaveBeenLastCalledWith('range_max', 4.1);
    await user.type(screen.getByTestId('value-fov'), '{ArrowDown}');
    expect(onChange).toHaveBeenLastCalledWith('fov', expect.closeTo((175 * Math.PI) / 180, 6));
  });

  it('show angles in degrees, also their bounds', async () => {
    const onChange = fields('drive', { max_angular: Math.PI });
    expect(screen.getByTestId('value-max_angular')).toHaveValue('180');
    await write('value-max_angular', '90');
    expect(onChange).toHaveBeenLastCalledWith('max_angular', expect.closeTo(Math.PI / 2, 6));
  });

  it('keep angles within their bounds, in degrees', async () => {
    const onChange = fields('lidar', { fov: Math.PI });
    await write('value-fov', '999');
    expect(onChange).toHaveBeenLastCalledWith('fov', expect.closeTo(2 * Math.PI + 0.001, 5));
    await write('value-fov', '0');
    expect(onChange).toHaveBeenLastCalledWith('fov', expect.closeTo(0.011, 5));
  });

  it.each(['front', '/front camera', `/${'a'.repeat(200)}`, ''])('refuse the topic "%s"', async (topic) => {
    const onChange = fields('lidar', { topic: '/scan' });
    const field = screen.getByTestId('value-topic');
    await user.clear(field);
    if (topic) await user.paste(topic);
    expect(screen.getByText(/A topic begins with \//)).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(onChange).not.toHaveBeenCalled();
  });

  it('take a topic of 200 letters', async () => {
    const onChange = fields('lidar', { topic: '/scan' });
    await user.clear(screen.getByTestId('value-topic'));
    await user.paste(`/${'a'.repeat(199)}`);
    await user.keyboard('{Enter}');
    expect(onChange).toHaveBeenCalledExactlyOnceWith('topic', `/${'a'.repeat(199)}`);
  });

  it('accept an empty topic if it is optional', async () => {
    const onChange = fields('camera', { topic: '/image', depth_topic: '/depth' });
    await write('value-depth_topic', '');
    expect(onChange).toHaveBeenCalledExactlyOnceWith('depth_topic', undefined);
  });

  it('name the values of a motor differently', () => {
    fields('motor', { topic: '/arm' });
    expect(screen.getByRole('group', { name: 'Motor' })).toBeInTheDocument();
    expect(screen.getByLabelText('Begins at')).toBeInTheDocument();
    expect(screen.getByLabelText('Force (N, Nm)')).toBeInTheDocument();
  });

  it('name the charge of a battery', () => {
    fields('battery');
    expect(screen.getByLabelText('Charge (0–1)')).toBeInTheDocument();
  });
});
