import document from '@catalog';
import { readCatalog } from '@/model/vocabulary';

/** The built-in nodes, from the table that engine and translator also use. */
export const catalog = readCatalog(document);
