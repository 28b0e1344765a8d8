import { allPastSamples, pastSamples } from '@/store/moment/pastTopics';
import { isLookingBack } from '@/store/moment/store';
import { seriesKey } from '@/store/session/topics';
import { dataOf, type Plotted, type SamplesOf } from './chart';
import { unitOf } from './plotView';

const quoted = (text: string): string => `"${text.replaceAll('"', '""')}"`;

/**
 * Returns the samples of all plotted fields as CSV: the time in s, and one column per field; gaps are empty.
 */
export function csvOf(plotted: Plotted, samplesOf?: SamplesOf): string {
  const [times, ...columns] = dataOf(plotted, samplesOf);
  const names = plotted.map(({ topic, path }) => {
    const unit = unitOf(path);
    return quoted(`${topic}.${path}${unit ? ` (${unit})` : ''}`);
  });
  const rows = [...times].map((time, index) =>
    [time, ...columns.map((column) => column[index] ?? '')].join(','),
  );
  return [['time_s', ...names].join(','), ...rows, ''].join('\r\n');
}

/** Downloads the samples of all plotted fields: those of the present, or all of the recording at a past moment. */
export async function downloadCsv(plotted: Plotted): Promise<void> {
  if (!isLookingBack()) return download('plot.csv', csvOf(plotted));
  const all = await allPastSamples(plotted);
  const of: SamplesOf = (topic, path) => {
    const recorded = all.get(seriesKey(topic, path));
    return recorded && recorded.times.length > 0 ? recorded : pastSamples(topic, path);
  };
  download('plot.csv', csvOf(plotted, of));
}

/** Downloads a text as a file. */
export function download(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: 'text/csv;charset=utf-8' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  URL.revokeObjectURL(url);
}
