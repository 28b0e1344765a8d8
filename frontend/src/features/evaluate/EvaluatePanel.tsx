import { Button, Group, Loader, NativeSelect, Text } from '@mantine/core';
import { useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { evaluationNames, evaluationPath } from '@/model/evaluation/files';
import type { Study } from '@/model/evaluation/study';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { useKeptFocus } from '@/ui/hooks/useKeptFocus';
import { useVisible } from '@/ui/hooks/useVisible';
import classes from './evaluate.module.css';
import { EvaluationActions } from './EvaluationActions';
import { EvaluationForm } from './EvaluationForm';
import { History } from './History';
import { NewEvaluation } from './NewEvaluation';
import { refusalText } from '@/i18n/evaluationReasons';
import { Results } from './Results';
import { StartForm } from './StartForm';
import { OpenStudy } from './study/OpenStudy';
import { StudyResults } from './study/StudyResults';
import { earlierOf, isLive, useEvaluations } from './useEvaluations';

/** The evaluations of the project: chosen or made, run, looked at, compared and played again. */
export function EvaluatePanel() {
  const { t } = useTranslation('evaluate');
  const panel = useRef<HTMLDivElement>(null);
  const isVisible = useVisible(panel);
  const head = useRef<HTMLDivElement>(null);
  useKeptFocus(panel);
  const files = useProjectStore((state) => state.files);
  const names = evaluationNames(Object.keys(files));
  const all = useEvaluations(isVisible);
  const [wanted, setWanted] = useState<string | null>(null);
  const [id, setId] = useState<string | null>(null);
  const [mode, setMode] = useState<'results' | 'form' | 'new' | 'study'>('results');
  const [study, setStudy] = useState<Study | null>(null);
  const [isStarting, setStarting] = useState(false);
  const name = wanted !== null && names.includes(wanted) ? wanted : (names[0] ?? null);
  const list = all.found.data;
  const shown = list?.items.find((item) => item.id === id) ?? list?.items[0] ?? null;
  const mayStart = list?.may_start === true;
  const canStart = mayStart && list.why_not === '';
  // In a narrow panel the results are below the fold.
  const reveal = () => requestAnimationFrame(() => head.current?.scrollIntoView({ block: 'nearest' }));
  const start = async (runs: number, sealed: boolean) => {
    if (name === null) return;
    setStarting(true);
    const made = await all.start(name, runs, sealed);
    setStarting(false);
    if (!made) return;
    setId(made.id);
    setMode('results');
    reveal();
  };
  return (
    <div ref={panel} className={classes['panel']} data-testid="evaluate">
      <div className={classes['columns']}>
        <div className={classes['side']}>
          {name !== null ? (
            <>
              <NativeSelect
                size="xs"
                label={t('choose')}
                value={name}
                data={names}
                onChange={({ currentTarget: { value } }) => setWanted(value)}
              />
              {canStart ? (
                <StartForm
                  key={name}
                  name={name}
                  costs={list?.costs ?? []}
                  isStarting={isStarting}
                  onStart={(runs, sealed) => void start(runs, sealed)}
                />
              ) : null}
              <Group gap={6}>
                {mayStart ? (
                  <Button
                    size="compact-xs"
                    variant="default"
                    aria-pressed={mode === 'form'}
                    onClick={() => setMode(mode === 'form' ? 'results' : 'form')}
                  >
                    {t('edit')}
                  </Button>
                ) : null}
                <Button size="compact-xs" variant="default" onClick={() => openFile(evaluationPath(name))}>
                  {t('yaml')}
                </Button>
                {mayStart ? (
                  <Button size="compact-xs" variant="default" onClick={() => setMode('new')}>
                    {t('new.open')}
                  </Button>
                ) : null}
                <OpenStudy
                  onOpen={(opened) => {
                    setStudy(opened);
                    setMode('study');
                  }}
                />
              </Group>
            </>
          ) : null}
          {list?.why_not ? (
            <Text size="xs" c="dimmed" role="note">
              {t(`whyNot.${list.why_not}`)}
            </Text>
          ) : null}
          {list && list.items.length > 0 ? (
            <History
              items={list.items}
              shown={mode === 'results' ? (shown?.id ?? null) : null}
              onShow={(next) => {
                setId(next);
                setMode('results');
                reveal();
              }}
            />
          ) : null}
        </div>
        <div className={classes['main']}>
          {all.found.isPending && isVisible ? (
            <Loader size={16} role="status" aria-label={t('loading')} />
          ) : null}
          {all.found.isError ? <p role="alert">{refusalText(t, all.found.error)}</p> : null}
          {mode === 'study' && study ? (
            <StudyResults study={study} onClose={() => setMode('results')} />
          ) : mode === 'new' || (name === null && list) ? (
            <NewEvaluation
              names={names}
              mayMake={mayStart}
              onCancel={name === null ? null : () => setMode('results')}
              onMade={(made) => {
                setWanted(made);
                setMode('form');
              }}
            />
          ) : mode === 'form' && name !== null ? (
            <EvaluationForm key={name} name={name} onClose={() => setMode('results')} />
          ) : shown ? (
            <>
              <div ref={head} className={classes['head']}>
                <h2 className={classes['title']}>
                  {shown.name}{' '}
                  <span className={classes['muted']}>
                    {t('revision', { revision: shown.revision })}
                    {shown.sealed ? ` · ${t('sealed.is')}` : ''} · {t(`state.${shown.state}`)}
                  </span>
                </h2>
                <EvaluationActions
                  key={`${shown.id} ${isLive(shown)}`}
                  projectId={all.projectId}
                  evaluation={shown}
                  earlier={earlierOf(shown, list?.items ?? [])}
                  mayStart={canStart}
                  onCancel={() => void all.cancel(shown.id)}
                  onResume={() => void all.resume(shown.id)}
                  onCompare={(revision) => void all.compare(shown.id, revision)}
                  onRemove={() => void all.remove(shown.id)}
                />
              </div>
              <Results
                key={shown.id}
                projectId={all.projectId}
                evaluation={shown}
                mayReplay={list?.may_replay === true && list.why_not === ''}
              />
            </>
          ) : list ? (
            <Text size="sm" c="dimmed">
              {t('none')}
            </Text>
          ) : null}
        </div>
      </div>
    </div>
  );
}
