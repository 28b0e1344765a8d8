import { TextInput, Tooltip } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconEar, IconEarOff, IconSearch } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import type { TopicInfo } from '@/generated/messages';
import { listen, showRecorded, unlisten } from '@/store/run/topics';
import { usePastTopics } from '@/store/moment/pastTopics';
import { useIsBack } from '@/store/moment/store';
import { useTopicsStore } from '@/store/session/topics';
import { bytesLabel, rateLabel } from './labels';
import classes from './topics.module.css';

const sizeClass = `${classes['number']} ${classes['size']}`;

/** The list of all topics, of a past moment those of the recording, with type, rate and size; a click echoes a topic. */
export function TopicList() {
  const { t } = useTranslation('topics');
  const isBack = useIsBack();
  const present = useTopicsStore((state) => state.topics);
  const isPresentKnown = useTopicsStore((state) => state.isKnown);
  const past = usePastTopics((state) => state.topics);
  const isPastKnown = usePastTopics((state) => state.isKnown);
  const topics = isBack ? past : present;
  const isKnown = isBack ? isPastKnown : isPresentKnown;
  const [search, setSearch] = useState('');
  const shown = useMemo(() => {
    const wanted = search.trim().toLowerCase();
    return topics.filter(({ name, type }) => `${name} ${type}`.toLowerCase().includes(wanted));
  }, [topics, search]);
  return (
    <div className={classes['list']}>
      <TextInput
        size="xs"
        type="search"
        className={classes['search']}
        value={search}
        placeholder={t('search')}
        aria-label={t('search')}
        leftSection={<IconSearch size={14} />}
        onChange={(event) => setSearch(event.currentTarget.value)}
      />
      {shown.length === 0 ? (
        <p className={classes['empty']}>
          {t(isKnown ? (isBack && topics.length === 0 ? 'past.empty' : 'nothingMatches') : 'asking')}
        </p>
      ) : (
        <table className={classes['table']}>
          <thead>
            <tr>
              <th scope="col">{t('name')}</th>
              <th scope="col" className={classes['type']}>
                {t('type')}
              </th>
              <th scope="col" className={classes['number']}>
                {t('rate')}
              </th>
              <th scope="col" className={sizeClass}>
                {t('size')}
              </th>
            </tr>
          </thead>
          <tbody>
            {shown.map((topic) => (
              <Row key={topic.name} topic={topic} />
            ))}
          </tbody>
        </table>
      )}
    </div>
  );
}

function Row({ topic }: { readonly topic: TopicInfo }) {
  const { t } = useTranslation('topics');
  const isBack = useIsBack();
  const isEchoed = useTopicsStore((state) => topic.name in state.echoes);
  const toggle = () => {
    if (isEchoed) return unlisten(topic.name);
    if (isBack) return showRecorded(topic.name);
    listen(topic.name).catch((error: Error) =>
      notifications.show({ color: 'red', title: t('refused'), message: reasonOf(error) }),
    );
  };
  const Icon = isEchoed ? IconEarOff : IconEar;
  const ends = [
    topic.type,
    ...(isBack
      ? []
      : [
          t('publishers', { names: topic.publishers.join(', ') || '—' }),
          t('subscribers', { names: topic.subscribers.join(', ') || '—' }),
        ]),
  ].join('\n');
  return (
    <tr data-testid={`topic-${topic.name}`} data-echoed={isEchoed || undefined} data-hz={topic.hz ?? ''}>
      <th scope="row">
        <Tooltip label={<span className={classes['ends']}>{ends}</span>} position="right" openDelay={500}>
          <button
            type="button"
            className={classes['topic']}
            aria-pressed={isEchoed}
            aria-label={t(labelOf(isEchoed, isBack), { topic: topic.name })}
            onClick={toggle}
          >
            <Icon size={14} aria-hidden="true" />
            <span>{topic.name}</span>
          </button>
        </Tooltip>
      </th>
      <td
        className={classes['type']}
        title={(topic.types.length > 0 ? topic.types : [topic.type]).join('\n')}
      >
        {topic.type.replace('/msg/', '/')}
        {topic.types.length > 1 ? ` +${topic.types.length - 1}` : ''}
      </td>
      <td className={classes['number']}>{rateLabel(topic.hz)}</td>
      <td className={sizeClass}>{bytesLabel(topic.bytes_per_s)}</td>
    </tr>
  );
}

function labelOf(isEchoed: boolean, isBack: boolean): 'unlisten' | 'listen' | 'past.hide' | 'past.show' {
  if (isBack) return isEchoed ? 'past.hide' : 'past.show';
  return isEchoed ? 'unlisten' : 'listen';
}
