import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { resetTopics, seriesOf } from '@/store/session/topics';
import * as pastTopics from '@/store/moment/pastTopics';
import { atPresent, useMoment } from '@/store/moment/store';
import { csvOf, download, downloadCsv } from './csv';

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

it('downloads all recorded samples while one looks back, and those of the page where nothing was recorded', async () => {
  const texts: Blob[] = [];
  vi.spyOn(HTMLAnchorElement.prototype, 'click').mockImplementation(() => undefined);
  vi.stubGlobal('URL', {
    createObjectURL: (blob: Blob) => (texts.push(blob), 'blob:x'),
    revokeObjectURL: vi.fn(),
  });
  vi.spyOn(pastTopics, 'allPastSamples').mockResolvedValue(
    new Map([
      ['/odom x', { times: [1, 2], values: [3, null] }],
      ['/own y', { times: [], values: [] }],
    ]),
  );
  Object.assign(seriesOf('/odom', 'x'), { times: [9], values: [9] });
  Object.assign(seriesOf('/own', 'y'), { times: [2], values: [5] });
  onTestFinished(() => {
    vi.unstubAllGlobals();
    useMoment.setState(atPresent);
    resetTopics();
  });
  const fields = [
    { topic: '/odom', path: 'x' },
    { topic: '/own', path: 'y' },
  ];
  await downloadCsv(fields);
  useMoment.setState({ t: 1 });
  await downloadCsv(fields);
  const rows = await Promise.all(texts.map((blob) => blob.text()));
  expect(rows).toEqual([
    'time_s,"/odom.x","/own.y"\r\n2,,5\r\n9,9,\r\n',
    'time_s,"/odom.x","/own.y"\r\n1,3,\r\n2,,5\r\n',
  ]);
});
