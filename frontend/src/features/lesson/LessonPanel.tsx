import { Button, Center, Checkbox, Text } from '@mantine/core';
import { IconAlertTriangle, IconBook2, IconCircleCheck } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { currentLanguage } from '@/i18n';
import { lessonPath } from '@/model/lesson/find';
import { parseLesson } from '@/model/lesson/parse';
import { LargeFile } from '@/features/code/LargeFile';
import { useProjectStore } from '@/store/project';
import { setOpensLessons, useLessons } from '@/workspace/lessons';
import { actForLesson } from '@/workspace/lessonTurns';
import classes from './lesson.module.css';
import { LessonText } from './LessonText';
import { perform, type Outcome } from './perform';

const START = `# Lesson\n\nWrite **Markdown** here. [Try it](try:run)\n`;

/** The project's lesson in the user's language. */
export function LessonPanel() {
  const { i18n } = useTranslation('lesson');
  const language = i18n.language.startsWith('es') ? 'es' : currentLanguage();
  const path = useProjectStore((state) => lessonPath(Object.keys(state.files), language));
  const text = useProjectStore((state) => (path === null ? null : state.currentText(path)));
  const isLarge = useProjectStore((state) => path !== null && state.files[path]?.kind === 'large');
  if (isLarge && path !== null) return <LargeFile path={path} />;
  return path === null || text === null ? <NoLesson /> : <Lesson key={path} text={text} />;
}

function NoLesson() {
  const { t } = useTranslation('lesson');
  const addFile = useProjectStore((state) => state.addFile);
  return (
    <Center h="100%" p="md">
      <div className={classes['none']}>
        <IconBook2 size={28} stroke={1.5} aria-hidden="true" />
        <Text size="sm" c="dimmed">
          {t('none')}
        </Text>
        <Button size="xs" variant="light" onClick={() => addFile(`lessons/${currentLanguage()}.md`, START)}>
          {t('write')}
        </Button>
      </div>
    </Center>
  );
}

function Lesson({ text }: { readonly text: string }) {
  const { t } = useTranslation('lesson');
  const blocks = useMemo(() => parseLesson(text), [text]);
  const [outcome, setOutcome] = useState<Outcome | null>(null);
  const opensLessons = useLessons((state) => state.opens);
  return (
    <div className={classes['panel']} data-testid="lesson">
      <section className={classes['page']} aria-label={t('label')}>
        <LessonText blocks={blocks} onTry={(act) => setOutcome(actForLesson(() => perform(act)))} />
        <Checkbox
          size="xs"
          mt="lg"
          label={t('opens')}
          checked={opensLessons}
          onChange={(event) => setOpensLessons(event.currentTarget.checked)}
        />
      </section>
      <div role="status" className={classes['outcome']} data-outcome={outcome?.kind}>
        {outcome ? <Said outcome={outcome} /> : null}
      </div>
    </div>
  );
}

const REFUSED: readonly Outcome['kind'][] = ['readOnly', 'noBlock', 'noPort', 'noFile'];

function Said({ outcome: { kind, values } }: { readonly outcome: Outcome }) {
  const { t } = useTranslation('lesson');
  const Icon = REFUSED.includes(kind) ? IconAlertTriangle : IconCircleCheck;
  return (
    <>
      <Icon size={16} aria-hidden="true" />
      <span>{t(`outcome.${kind}`, values)}</span>
    </>
  );
}
