import type { Namespace, TFunction } from 'i18next';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { useIsBasic } from '@/store/viewMode';

/**
 * The texts of a namespace; the basic page takes those whose key ends with `_basic`, where there are such, in
 * which a beginner finds no *tick*.
 */
export function usePlainWords<N extends Namespace>(namespace: N): TFunction<N> {
  const { t } = useTranslation(namespace);
  const isBasic = useIsBasic();
  return useMemo(() => {
    if (!isBasic) return t as TFunction<N>;
    const plain = (key: string, values?: Record<string, unknown>) =>
      (t as (key: string, values: Record<string, unknown>) => string)(key, { context: 'basic', ...values });
    return plain as unknown as TFunction<N>;
  }, [t, isBasic]);
}
