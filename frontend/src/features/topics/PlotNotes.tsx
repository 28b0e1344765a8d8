import { useTranslation } from 'react-i18next';
import { pastSamples, usePastTopics } from '@/store/moment/pastTopics';
import type { Lack } from '@/store/recording/topics/topicQueries';
import { seriesKey } from '@/store/session/topics';
import type { Plotted } from './chart';
import classes from './topics.module.css';

type Note = Lack | 'own';

const NOTES: readonly Note[] = ['topic', 'own', 'field', 'size', 'thinned'];

/** What a plot of a past moment lacks: fields that are not in the recording, and what is still being read. */
export function PlotNotes({ plotted }: { readonly plotted: Plotted }) {
  const { t } = useTranslation('topics');
  const series = usePastTopics((state) => state.series);
  const isReading = usePastTopics((state) => state.isReading);
  const lacks = plotted.map(({ topic, path }) => ({
    field: `${topic}.${path}`,
    note: noteOf(topic, path, series.get(seriesKey(topic, path))?.lack ?? null),
  }));
  const lines = NOTES.flatMap((note) => {
    const fields = lacks.filter((each) => each.note === note).map(({ field }) => field);
    return fields.length > 0 ? [t(`past.${note}`, { fields: fields.join(', ') })] : [];
  });
  return (
    <div role="status" className={classes['plotNotes']} data-testid="plot-notes">
      {[...lines, ...(isReading ? [t('past.reading')] : [])].map((line) => (
        <p key={line}>{line}</p>
      ))}
    </div>
  );
}

function noteOf(topic: string, path: string, lack: Lack | null): Note | null {
  return lack === 'topic' && pastSamples(topic, path).times.length > 0 ? 'own' : lack;
}
