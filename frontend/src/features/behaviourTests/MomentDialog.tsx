import { Modal } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { storyUntilNow } from '@/store/moment/looking';
import type { Story } from '@/store/recording/story';
import { closeMomentTest, useMomentTest } from '@/store/dialogs/momentTest';
import { MomentForm } from './MomentForm';
import classes from './moment.module.css';

/** The dialogue that makes a behaviour test of the shown moment. */
export function MomentDialog() {
  const { t } = useTranslation('behaviourTests');
  const { isOpen } = useMomentTest();
  return (
    <Modal opened={isOpen} onClose={closeMomentTest} title={t('moment.title')} size={560}>
      {isOpen ? <Content /> : null}
    </Modal>
  );
}

function Content() {
  const { t } = useTranslation('behaviourTests');
  const [story, setStory] = useState<Story | null | undefined>(undefined);
  const [failure, setFailure] = useState('');
  useEffect(() => {
    let isCurrent = true;
    storyUntilNow().then(
      (found) => {
        if (isCurrent) setStory(found);
      },
      (error: Error) => {
        if (isCurrent) setFailure(error.message);
      },
    );
    return () => {
      isCurrent = false;
    };
  }, []);
  if (failure !== '') return <p role="alert">{t('moment.unread', { reason: failure })}</p>;
  if (story === undefined) return <p role="status">{t('moment.reading')}</p>;
  if (story === null) return <p className={classes['muted']}>{t('moment.noTick')}</p>;
  return <MomentForm story={story} />;
}
