import { dataOf, type Plotted } from './chart';
import { unitOf } from './plotView';

const quoted = (text: string): string => `"${text.replaceAll('"', '""')}"`;

/**
 * Returns the samples of all plotted fields as CSV: the time in s, and one column per field; gaps are empty.
 */
export function csvOf(plotted: Plotted): string {
  const [times, ...columns] = dataOf(plotted);
  const names = plotted.map(({ topic, path }) => {
    const unit = unitOf(path);
    return quoted(`${topic}.${path}${unit ? ` (${unit})` : ''}`);
  });
  const rows = [...times].map((time, index) =>
    [time, ...columns.map((column) => column[index] ?? '')].join(','),
  );
  return [['time_s', ...names].join(','), ...rows, ''].join('\r\n');
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
