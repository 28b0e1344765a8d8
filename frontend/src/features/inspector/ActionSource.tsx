import { Button } from '@mantine/core';
import { Suspense, useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { create } from 'zustand';
import { actionPath } from '@/store/project/state';
import { useFileText } from '@/store/saving/large';
import { lazyPart } from '@/ui/parts';
import { Section } from './Section';
import classes from './Inspector.module.css';

const SourceView = lazyPart(async () => (await import('./SourceView')).SourceView);

/** Whether the source is open; it stays open when the user selects another action. */
const useShown = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

/** The source of the block's action, which cannot be edited here. */
export function ActionSource({ action }: { readonly action: string }) {
  const { t } = useTranslation('inspector');
  const isOpen = useShown((state) => state.isOpen);
  const view = useRef<HTMLDivElement>(null);
  const path = actionPath(action);
  const text = useFileText(path);
  if (text === null) return null;
  return (
    <Section
      title={t('source')}
      action={
        <Button
          size="compact-xs"
          variant="subtle"
          color="gray"
          aria-expanded={isOpen}
          onClick={() => {
            useShown.setState({ isOpen: !isOpen });
            setTimeout(() => view.current?.scrollIntoView({ block: 'nearest' }));
          }}
        >
          {t(isOpen ? 'hideSource' : 'showSource')}
        </Button>
      }
    >
      {isOpen && (
        <div ref={view} className={classes['source']}>
          <Suspense fallback={null}>
            <SourceView path={path} text={text} />
          </Suspense>
        </div>
      )}
    </Section>
  );
}
