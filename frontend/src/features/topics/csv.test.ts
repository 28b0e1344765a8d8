import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { resetTopics, seriesOf } from '@/store/session/topics';
import { csvOf, download } from './csv';

describe('csvOf', () => {
  it('has the time and one column for each field, with empty gaps', () => {
    Object.assign(seriesOf('/odom', 'linear.x'), { times: [0.5, 1], values: [1, null] });
    Object.assign(seriesOf('/a"b', 'data'), { times: [1], values: [7] });
    onTestFinished(resetTopics);
    const fields = [
      { topic: '/odom', path: 'linear.x' },
      { topic: '/a"b', path: 'data' },
    ];
    expect(csvOf(fields)).toBe('time_s,"/odom.linear.x (m/s)","/a""b.data"\r\n0.5,1,\r\n1,,7\r\n');
  });
});

it('downloads a file of its name', () => {
  const click = vi.spyOn(HTMLAnchorElement.prototype, 'click').mockImplementation(() => undefined);
  vi.stubGlobal('URL', { createObjectURL: () => 'blob:x', revokeObjectURL: vi.fn() });
  download('plot.csv', 'a');
  const [link] = click.mock.contexts as HTMLAnchorElement[];
  expect(link?.download).toBe('plot.csv');
  vi.unstubAllGlobals();
});
