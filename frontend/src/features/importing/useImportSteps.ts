import { useEffect, useRef, useState } from 'react';
import { imports, type ImportedPart, type ImportWish, type Inspection, type Upload } from '@/api/imports';
import type { Before } from '@/features/editor3d/imported';
import type { Source } from '@/store/dialogs/importing';
import { useProjectStore } from '@/store/project';
import { importPart, type WrittenPart } from '@/store/saving/importPart';
import { pack } from './pack';

/** What the dialogue shows. */
export type Step =
  | { readonly kind: 'choose' }
  | {
      readonly kind: 'busy';
      readonly what: 'packing' | 'looking' | 'importing';
      readonly share: number | null;
    }
  | {
      readonly kind: 'options';
      readonly upload: Upload;
      readonly found: Inspection;
      /** What was entered before an import failed or was cancelled. */
      readonly wish?: ImportWish;
    }
  | { readonly kind: 'done'; readonly part: ImportedPart; readonly wish: ImportWish };

interface Steps {
  readonly step: Step;
  readonly error: Error | null;
  readonly choose: (source: Source) => void;
  readonly take: (wish: ImportWish) => void;
  /** Ends what is being done; the step before is shown again. */
  readonly cancel: () => void;
  /** Begins again with other files. */
  readonly restart: () => void;
}

/** Called with what an import wrote, and the project before it; it is late if the user had cancelled it. */
type OnWritten = (part: WrittenPart, wish: ImportWish, before: Before, isLate: boolean) => void;

const isAbort = (error: unknown) => error instanceof Error && error.name === 'AbortError';

/** The steps of an import: files, what is in them, and the report. */
export function useImportSteps(projectId: string, first: Source | null, onWritten: OnWritten): Steps {
  const [step, setStep] = useState<Step>({ kind: 'choose' });
  const [error, setError] = useState<Error | null>(null);
  const [looked, setLooked] = useState<Extract<Step, { kind: 'options' }> | null>(null);
  const running = useRef<AbortController | null>(null);

  /** Does something that can be cancelled; `back` is shown if it fails. */
  const perform = async (back: Step, work: (signal: AbortSignal) => Promise<Step>) => {
    running.current?.abort();
    const own = new AbortController();
    running.current = own;
    setError(null);
    try {
      const next = await work(own.signal);
      if (running.current === own) setStep(next);
    } catch (caught) {
      if (running.current !== own) return;
      setStep(back);
      if (!isAbort(caught)) setError(caught instanceof Error ? caught : new Error(String(caught)));
    }
  };

  const choose = (source: Source) => {
    setStep({ kind: 'busy', what: 'packing', share: 0 });
    void perform({ kind: 'choose' }, async (signal) => {
      const upload = await pack(source, signal, (share) => {
        if (!signal.aborted) setStep({ kind: 'busy', what: 'packing', share });
      });
      setStep({ kind: 'busy', what: 'looking', share: null });
      const found = await imports.inspect(projectId, upload, signal);
      const options = { kind: 'options', upload, found } as const;
      setLooked(options);
      return options;
    });
  };

  const take = (wish: ImportWish) => {
    if (looked === null) return;
    // The report of an import, which may be simplified, stays until there is another one.
    const back: Step = step.kind === 'done' ? step : { ...looked, wish };
    const before = useProjectStore.getState();
    setStep({ kind: 'busy', what: 'importing', share: null });
    void perform(back, async (signal) => {
      const onLate = (part: WrittenPart) => onWritten(part, wish, before, true);
      const part = await importPart(projectId, looked.upload, wish, signal, onLate);
      onWritten(part, wish, before, false);
      return { kind: 'done', part, wish };
    });
  };

  useEffect(() => {
    const timer = setTimeout(() => first && choose(first));
    return () => {
      clearTimeout(timer);
      running.current?.abort();
    };
    // The dialogue begins again for other files.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, []);

  return {
    step,
    error,
    choose,
    take,
    cancel: () => running.current?.abort(),
    restart: () => {
      setError(null);
      setStep({ kind: 'choose' });
    },
  };
}
