#pragma once
#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_Import_fwd.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <Tpetra_MultiVector_fwd.hpp>
#include <Tpetra_Operator_fwd.hpp>

#include <Teuchos_RCPDecl.hpp>

namespace suture {

// Distributed objects are those of Tpetra, for double / int / long long only.
using Map = Tpetra::Map<>;
using Import = Tpetra::Import<>;
using MultiVector = Tpetra::MultiVector<>;
using Operator = Tpetra::Operator<>;
using MapPtr = Teuchos::RCP<const Map>;
using MultiVectorPtr = Teuchos::RCP<MultiVector>;

}  // namespace suture
